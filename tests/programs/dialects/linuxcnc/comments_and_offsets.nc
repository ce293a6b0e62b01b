; tool 2 4
; a comment line
G21 (mm) G90 G54 ; more
T2 M6
G43
G92 X0 Y0 Z0
G0 X-20 Y0
G1 Z-1 F100
G42 D2 X0 Y0 (entry)
X50
Y30
X0
Y-10
G40 X-20
G92.1
G0 G53 Z0
M2
