; tool 1 5
; tool 2 3
; refused 900017 line 8
G21 G90 G17
T1 M6
/T2 M6
G0 X-20. Y-20.
G41 G1 X0. Y0. F300.
Y40.
M30
