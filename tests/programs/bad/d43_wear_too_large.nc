; expect: 900222 at line 5
; setup: wear -1.5
(the wear of the tool in the setup is beyond max_wear, 1 mm; the radius is the program's own)
N10 G00 X0 Y-30 F1000
N20 V.G.WZ_AKT.R = 5 G41 G01 X0 Y0
N30 X50
N40 G40 Y-30
