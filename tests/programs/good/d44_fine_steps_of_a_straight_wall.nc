%STEPS
(points every 0.02 mm of a straight wall in three decimals: the kinks would take 0.2 mm of them)
N10 G0 X-5 Y0 F500
V.G.WZ_AKT.R=6
G140 G25
N20 G41 G1 X0 Y0
N30 X10.000 Y1.429
N40 X10.020 Y1.431
N50 X10.040 Y1.434
N60 X10.060 Y1.437
N70 X20.000 Y2.857
N80 G40 G1 X25 Y30
M30
