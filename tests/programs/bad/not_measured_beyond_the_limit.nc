; expect: 900212 at line 12
; setup: selection_blocks 4
; setup: verify report
; (to be measured a contour is held, here no more than four blocks of it: the path comes out, and
; that it was not measured is a warning)
N10 G00 X-20 Y-20 F1000
N20 V.G.WZ_AKT.R = 5
N40 G41 G01 X0 Y0
N50 Y40
N60 X40
N70 Y20
N80 X60
N90 Y0
N100 X0
N110 G40 X-20 Y-20
N120 M30
