; radius 5
; path -5 -10 L; -5 40 L; 0 45 A; 60 45 L; 80 40 L
G21 G17 G90 G40
T1 M6
G0 X-20 Y-20
G41 D1 g 1 x 0 y -1 0 f 50 0
y 4 0 .
X 6 0. 0
G 40 G1 X80
M2
