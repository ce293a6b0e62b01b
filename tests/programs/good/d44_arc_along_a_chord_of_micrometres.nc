%CHORD
(the centre of N40 is rounded to three decimals: 0.14 mm along the chord, 1.5 um of radius)
N10 G0 X0 Y-5 F100
V.G.WZ_AKT.R=0.2
N20 G42 G1 X0 Y0
N30 X10
N40 G3 X10.007 Y0.001 I0.053 J0.65
N50 G1 X20 Y1
N60 G40 X30 Y-5
M30
