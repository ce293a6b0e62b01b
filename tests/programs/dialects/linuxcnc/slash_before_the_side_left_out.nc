; block_skip leave_out
; radius 5
; path -5 0 L; -5 40 L; -20 60 L
G21 G90 G17
/ #1=7
G0 X-20 Y-20
/ g42 d7
g41
G1 X0 Y0 F300
/ X#1
/X60 (only a blank)
Y[40]
/1 G40 X-20 Y60
G40 X-20 Y60
M2
