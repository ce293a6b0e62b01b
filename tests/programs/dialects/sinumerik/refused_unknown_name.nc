; tool 5 5 1 MILL_10
; refused 900013 line 4
; Another name than that of the table.
N10 G17 G54 G71 G90 T="MILL_12" D1
N20 G41 G1 X0 Y0 F500
N30 Y20
N40 G40 X-20
N50 M30
