; setup: allowance -6
(5 - 6 mm: one millimetre on the other side)
N10 G00 X-20 Y0 F1000
N20 V.G.WZ_AKT.R = 5
N30 G138 G41 G01 X0 Y0
N40 X50
N50 Y-50
N60 G40 X30 Y-60
