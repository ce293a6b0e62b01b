; radius 5
; path -5 0 L; -5 40 L; -20 60 L
G21 G90 G17 G40.1 G50.2
G0 X - 20. Y -20.
G41 D1 G1 X+ 0 Y0 F300.
Y + 40.
G40 X -	20. Y60.
M30
