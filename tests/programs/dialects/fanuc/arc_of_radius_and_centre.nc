; radius 2
; path -2 0 L; -2 20 L; 20 42 A; 40 42 L; 40 60 L
; R counts: I and J, wrong here, are passed over (D-126).
G21 G90 G17
G0 X-20. Y0
G41 D1 G1 X0 Y0 F300.
Y20.
G2 X20. Y40. I15. J1. R20.
G1 X40.
G40 Y60.
M30
