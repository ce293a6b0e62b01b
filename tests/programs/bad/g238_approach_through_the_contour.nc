; expect: 900210 at line 7
; The tool comes from outside, through the wall X100 (D-152).
N10 G00 X150 Y120
N20 G238 V.G.WZ_AKT.R = 5
N30 G41 G01 X0 Y0 F1000
N35 X100
N40 Y100
N50 X0
N60 Y0
N70 G40 X50 Y50
N80 M30
