; expect: 900305 at line 4
; setup: dialect fanuc
G0 X0 Y0
GOTO 500
M30
