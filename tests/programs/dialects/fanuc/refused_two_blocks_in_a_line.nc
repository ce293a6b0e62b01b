; radius 2 (D-53)
; refused 900003 line 6
G17 G21 G90 ; millimetres
T1 M6 ; D10
G0 X-10. Y-10. ;
G41 D1 G1 X0 Y0 F300.; Y20.;
X20.
G40 X-10.
M30
