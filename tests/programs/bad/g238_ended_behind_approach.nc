; expect: 900208 at line 5
; There is no contour that could close (D-152).
N10 G00 X50 Y50
N20 G238 V.G.WZ_AKT.R = 5
N30 G41 G01 X0 Y0 F1000
N40 M30
