; expect: 900008 at line 3
G01 X0 Y0 F500
X10 F0
M30
