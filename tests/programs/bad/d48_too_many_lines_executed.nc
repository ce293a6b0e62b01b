; expect: 900301 at line 5
; setup: dialect fanuc
; setup: max_executed_lines 100
N10 G0 X0 Y0
GOTO 10
