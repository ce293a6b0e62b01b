; expect: 900219 at line 4
(there is no radius that could become larger)
N10 G00 X0 Y-30 F1000
N20 V.G.WZ_AKT.R = V.G.WZ_AKT.R + 0.2
N30 G41 G01 X0 Y0
N40 X50
N50 G40 Y-30
