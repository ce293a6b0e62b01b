%HALF
(N40 turns by 180.006 degrees; the inside corner after it ends its path at 167)
V.G.WZ_AKT.R=2
N10 G0 X-20 Y-10 F500
N20 G41 G1 X0 Y0
N30 X0 Y10
V.G.WZ_AKT.R=1.7
N40 G2 X20 Y9.999 I10 J0
N50 G1 X40 Y20
N60 G40 X50 Y30
M30
