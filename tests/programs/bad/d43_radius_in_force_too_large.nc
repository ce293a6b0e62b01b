; expect: 900104 at line 6
; setup: nominal_radius 214748
; setup: allowance 1
(the tool radius in force, 214748 + 1 + 0.5 mm, is larger than any may be)
N10 G00 X0 Y-30 F1000
N20 V.G.WZ_AKT.R = 0.5
N30 G41 G01 X0 Y0
N40 X50
N50 G40 X50 Y-30
