; expect: 900306 at line 4
; setup: dialect fanuc
G0 X0 Y0
M98 P1001
M30
