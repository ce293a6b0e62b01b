; expect: 900307 at line 4
; setup: dialect fanuc
G0 X0 Y0
#100=#5021
M30
