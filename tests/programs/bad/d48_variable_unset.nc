; expect: 900303 at line 4
; setup: dialect fanuc
G0 X0 Y0
G1 X#500 Y10. F100
M30
