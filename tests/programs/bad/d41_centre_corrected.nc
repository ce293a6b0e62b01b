; expect: 900221 at line 4
N10 G00 X0 Y0
(start and end are 30.00 and 30.05 from the centre)
N20 G02 X60.05 Y0 I30 F500
N30 M30
