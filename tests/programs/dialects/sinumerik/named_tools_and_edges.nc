; tool 5 5 1 MILL_10
; tool 5 4 2 MILL_10
; tool 2147483648 3 1 FINISH
; path -5 0 L; -5 50 L; -30 50 L; -30 -30 L; -4 0 L; -4 50 L; -30 50 L; -30 -30 L; -3 0 L; -3 50 L; -30 50 L
; The same wall with the first edge of a tool, with its second one, and with a tool that has its
; name alone; names in letters of any case.
N10 G17 G54 G71 G90
N20 T="Mill_10" D1
N30 M6
N40 G0 X-30 Y-30
N50 G41 G1 X0 Y0 F500
N60 Y50
N70 G40 X-30
N80 D2
N90 G0 X-30 Y-30
N100 G41 G1 X0 Y0 F500
N110 Y50
N120 G40 X-30
N130 T="FINISH"
N140 M6
N150 G0 X-30 Y-30
N160 G41 G1 X0 Y0 F500
N170 Y50
N180 G40 X-30
N190 M30
