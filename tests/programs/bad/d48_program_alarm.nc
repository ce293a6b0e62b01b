; expect: 900312 at line 5
; setup: dialect fanuc
G0 X0 Y0
IF [#1 NE #0] GOTO 10
#3000=1 (NO DEPTH)
N10 M30
