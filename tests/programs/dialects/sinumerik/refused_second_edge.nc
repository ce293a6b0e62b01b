; tool 1 5
; refused 900013 line 4
; D2 is the second edge of T1: its radius stands in no table of tools.
G17 G90 G71 T1 D2
G41 G1 X0 Y0 F500
Y20
G40 X-20
M30
