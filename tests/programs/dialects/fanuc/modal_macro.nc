; radius 2
; path -2 0 L; -2 40 L; -20 40 L
; A macro after each position, and one of the machine.
G21 G90 G17
G66 P100 A2. B5. (HOLES)
G0 X10. Y10.
X20.
G67
G66 P9815 H2.
G0 X30.
G67
G0 G90 X-20. Y0 Z1.
G41 D1 G1 X0 Y0 F300.
Y40.
G40 X-20.
M30
O100
G81 Z-#1 R#2 F100.
G80
M99
