; expect: 900208 at line 8
; Begins in an inside corner, but does not come back to it (D-152).
N10 G00 X50 Y50
N20 G238 V.G.WZ_AKT.R = 5
N30 G41 G01 X0 Y0 F1000
N40 X100
N50 Y100
N60 X0
N70 G40 X50 Y50
N80 M30
