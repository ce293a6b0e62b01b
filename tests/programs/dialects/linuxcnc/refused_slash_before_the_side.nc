; refused 900017 line 6
; radius 5
G21 G90 G17
G0 X-20 Y-20
(with block delete off it runs as written)
/ g41
G1 X0 Y0 F300
Y40
G40 X-20 Y60
M2
