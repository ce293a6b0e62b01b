; expect: 900102 at line 6
; setup: look_ahead 50
; (D-10: a window bounds memory and delay; a selection held as a whole would not)
N10 G00 X0 Y-20
N20 G141 V.G.WZ_AKT.R = 10
N30 G41 G01 X0 Y0 F1000
N40 X50
N50 X55 Y5
N60 Y50
N70 G40 X0 Y80
N80 M30
