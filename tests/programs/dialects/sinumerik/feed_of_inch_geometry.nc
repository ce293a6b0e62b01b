; radius 0.19685039370078741 in
; path -5 0 L; -5 50.8 L; 0 55.8 A; 76.2 55.8 L; 101.6 50.8 L
; G70 is of lengths alone: feeds stay mm/min, also where they are written anew.
G90 G17 G40 G70
T1 D1
G0 X-1 Y-1
G1 Z-0.1 F100
G41 G1 X0 Y0 F500
Y2
G1 Z-0.2 F80
X3
G40 X4 Y2
M30
