; expect: 900009 at line 3
N10 G00 X0 Y0
N20 G01 X50 (finish Y20 F500
N30 M30
