; expect: 900007 at line 3
N10 G00 X0 Y0
N20 G01 X10 (bell )
N30 M30
