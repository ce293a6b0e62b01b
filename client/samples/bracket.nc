%bracket
; The outside of a bracket with a round corner, a notch and a bore eye,
; cut with a 12 mm tool on the left of the contour.
N10 G00 X-25 Y-20 Z5
N20 G26 G139 (arcs at outside corners)
N30 V.G.WZ_AKT.R = 6
N40 G41 G01 X0 Y0 F800
N50 G01 Z-4 F200
N60 Y50 F800
N70 G02 X15 Y65 R15
N80 G01 X45
N90 Y45
N100 X65
N110 Y60
N120 G02 X105 I20 J0
N130 G01 X105 Y20
N140 X80 Y0
N150 X0
N160 G01 Z5
N170 G40 X-25 Y-10
N180 M30
