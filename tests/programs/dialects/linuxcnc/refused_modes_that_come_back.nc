; radius 5
; refused 900003 line 7
G21 G90 G17
T1 M6
G0 X-20 Y-20 Z5
o1 sub
M73
G91 G1 Z-8 F100
o1 endsub
o1 call
G41 D1 G1 X0 Y0 F300
Y40
X60
G40 X-20 Y-20
M2
