; expect: 900015 at line 5
N10 G00 X0 Y0
N20 M30
(behind the end G41 is text here)
N30 X5 G0041 Y7
