; expect: 900216 at line *
; setup: verify
; (a change of side ends the contour for masking, as G40 and a new selection would; measured is all
; of it: the path beside N30 comes near to the slot after the change)
N10 G00 X-20 Y0 F1000
N20 G138 G26 G141 V.G.WZ_AKT.R = 5
#TRC[REMOVE_MASKED_BLOCKS=1]
N25 G41 G01 X0 Y0
N30 X60
N40 G42 X70 Y20
N50 Y40
N60 X30
N70 Y7
N80 X20
N90 Y40
N100 X0
N110 G40 X-20
N120 M30
