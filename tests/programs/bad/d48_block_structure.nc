; expect: 900310 at line 4
; setup: dialect fanuc
#1=5
WHILE [#1 LT 3] DO1
#1=#1+1
END2
M30
