; expect: 900019 at line 5
; setup: dialect fanuc
G21 G17 G90 F300
G10 L12 P1 R5.
G41 D1 X0 Y0
Y40.
