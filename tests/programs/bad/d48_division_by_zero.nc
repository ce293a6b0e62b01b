; expect: 900304 at line 4
; setup: dialect fanuc
#1=0
G0 X[10/#1]
M30
