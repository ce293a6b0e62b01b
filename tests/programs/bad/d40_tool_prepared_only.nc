; expect: 900219 at line 7
; setup: tool 2 5
N10 G00 X0 Y0
N20 M06
N30 T2
(tool 2 is made ready but never comes into the spindle)
N40 G41 G01 X10 Y10 F500
N50 X50
N60 G40 X60 Y-10
N70 M30
