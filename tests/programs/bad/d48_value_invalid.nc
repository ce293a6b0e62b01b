; expect: 900309 at line 4
; setup: dialect fanuc
#1=2
G0 X[ASIN[#1]]
M30
