; setup: tool 1 10
; setup: allowance 0.25
(10 mm, 0.25 mm of stock, and 0.1 mm worn off after the first corner)
N10 G00 X-20 Y0 F1000
N20 D1
N30 G138 G41 G01 X0 Y0
N40 X50
N50 V.G.WZ_AKT.R = V.G.WZ_AKT.R - 0.1
N60 Y50
N70 X0
N80 G40 X-20
