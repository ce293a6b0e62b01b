; expect: 900218 at line 8
; D-39: the tool does not get through the neck of the pocket, which is most of the contour.
N10 G00 X-80 Y30 F1000
N20 V.G.WZ_AKT.R = 10
N30 #TRC[REMOVE_MASKED_BLOCKS=1]
N40 G41 G141 G01 X-60 Y0
N50 X-5
N60 Y-20
N70 X-80
N80 Y-100
N90 X80
N100 Y-20
N110 X5
N120 Y0
N130 X60
N140 G40 X80 Y30
N150 M30
