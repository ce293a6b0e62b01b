; block_skip execute
; radius 5
; path -5 0 L; -5 40 L; -20 60 L
%
O0001
G21 G90 G17
/2 G28 G91 Z0
/ G90
G0 X-20. Y-20.
/M1
/G41 D1 G1 X0 Y0 F300.
/3 N10 Y40.
G40 X-20. Y60.
M30
%
