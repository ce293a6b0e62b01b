; expect: 900308 at line 4
; setup: dialect fanuc
#1=5
G0 X#1+5
M30
