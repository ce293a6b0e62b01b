; block_skip execute
; radius 5
; path -5 0 L; -5 40 L; -20 60 L
G21 G90 G17
/ G28 Z0
G0 X-20 Y-20
/M8
/ g41
G1 X0 Y0 F300
/Y40
G40 X-20 Y60
/ M9
M2
