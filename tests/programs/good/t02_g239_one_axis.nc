%LEAVE_ONE_AXIS
N10 G00 X0 Y0 Z0 F1000
N20 G239 (approach directly, leave without a block)
N30 V.G.WZ_AKT.R = 10
N40 G41 G01 X30 Y20 (tool left of the contour)
N50 G01 X60
N60 X90
N70 G01 X120
N80 G40 (the last equidistant point becomes the position)
N90 G00 X150
N100 X200
N110 M30
