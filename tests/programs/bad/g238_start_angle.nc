; expect: 90130 at line 5
; Outside of a square, begun at an outside corner round which the tool would have to go.
N10 G00 X60 Y-40
N20 G238 V.G.WZ_AKT.R = 5
N30 G41 G01 X0 Y0 F1000
N40 Y100
N50 X100
N60 Y0
N70 X0
N80 G40 X60 Y-40
N90 M30
