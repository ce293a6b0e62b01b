; expect: 900216 at line *
; setup: verify
(the neck is 15 wide, the tool 20: a bottleneck G140 does not see)
N10 G00 X-60 Y-80 F1000
N20 V.G.WZ_AKT.R = 10
N30 G41 G01 X-60 Y-40
N40 X0
N50 Y0
N60 X50
N70 Y-10
N80 X90
N90 Y25
N100 X50
N110 Y15
N120 X5
N130 Y75
N140 X-60
N150 G40 Y95
N160 M30
