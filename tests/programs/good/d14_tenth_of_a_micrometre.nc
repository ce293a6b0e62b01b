(D-14: the chamfer is too short by half a tenth of a micrometre)
N10 G00 X-30 Y0 F1000
N20 V.G.WZ_AKT.R = 10
N30 G41 G01 X0
N40 X50
N50 X55.857829 Y5.857829
N60 Y50
N70 G40 Y80
N80 M30
