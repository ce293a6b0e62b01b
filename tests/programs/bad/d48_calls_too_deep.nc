; expect: 900302 at line 7
; setup: dialect fanuc
G0 X0 Y0
M98 P100
M30
O100
M98 P100
M99
