; setup: nominal_radius 5
(the centre path of a tool of 5 mm; the one used has 4.9 mm, and turns about the inside corner)
N10 G00 X-20 Y0 F1000
N20 V.G.WZ_AKT.R = -0.1
N30 G26 G138 G41 G01 X0 Y0
N40 X50
N50 Y50
N60 G40 X30 Y60
