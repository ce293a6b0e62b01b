; expect: 900206 at line 7
; The block that changes the side must be straight.
N10 G00 X-20 Y-20
N20 V.G.WZ_AKT.R = 5
N30 G41 G01 X0 Y0 F1000
N40 X50
N50 G42 G02 X70 Y-20 R20
N60 G01 Y-60
N70 G40 X90 Y-80
N80 M30
