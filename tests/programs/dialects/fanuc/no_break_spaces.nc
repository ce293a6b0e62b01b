; radius 2
; path -2 0 L; -2 40 L; -20 40 L
; No-break spaces, as web pages have them.
G21 G90 G17
G0 X-20.  Y0
#1= 5
G41 D1 G1 X0 Y0 F300.
N10 Y40.
G40 X-20.
M30
