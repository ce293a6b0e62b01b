; expect: 900003 at line 3
N10 G00 X0 Y0
N20 P5
N30 M30
