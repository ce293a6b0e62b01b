; expect: 900215 at line 9
; setup: look_ahead 2
; (D-10: what lies beyond the window is not looked for, and that is said)
N10 G00 X0 Y-20
N20 G141 V.G.WZ_AKT.R = 10
N30 G41 G01 X0 Y0 F1000
N40 X50
N50 Y50
N60 X0
N70 Y20
N80 G40 X20
N90 M30
