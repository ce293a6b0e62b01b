%g239_demo (approach and retract with G239, tool radius 10 mm)
N10 G90 G17 G00 X0 Y0
N20 G239
N30 V.G.WZ_AKT.R = 10
N40 G41 G01 X30 Y20 F1000 (approach: ends straight above the start of the edge)
N50 X60
N60 X90
N70 X120
N80 G40
N90 G00 X150 Y0           (retract)
N100 M30
