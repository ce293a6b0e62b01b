; expect: 20035 at line 4
N10 G00 X0 Y0
(a radius of 1 mm; the shift of 1.9 mm is within P-CHAN-00059)
N20 G02 X5.8 Y0 I1 F500
N30 M30
