; expect: 900222 at line 6
; setup: nominal_radius 5
(the program is the centre path of a tool of 5 mm; D holds what the tool differs from that)
N10 G00 X0 Y-30 F1000
N20 V.G.WZ_AKT.R = 4.98
N30 G41 G01 X0 Y0
N40 X50
N50 Y50
N60 G40 X100
