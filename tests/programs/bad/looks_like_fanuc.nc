; expect: 900016 at line 3
G90 G17
G20 G40
G00 X1 Y2
