; expect: 90057 at line 5
; The tangential arc is smaller than the tool, its centre away from the tool: no feed at the contour.
N10 G00 X18 Y22
N20 G11 V.G.WZ_AKT.R = 5
N30 G05 G41 G01 X20 Y20 F1000
N40 X60
N50 G40 X90 Y0
N60 M30
