; expect: 900207 at line 5
; No contour block lies on the left side (D-150).
N10 G00 X-20 Y-20
N20 V.G.WZ_AKT.R = 5
N30 G41 G01 X0 Y0 F1000
N40 G42 X50
N50 Y50
N60 G40 X90 Y80
N70 M30
