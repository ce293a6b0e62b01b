; expect: 90017 at line 9
; setup: nominal_radius 5
; setup: allowance 0.25
(the centre path has an arc of 0.1 mm: a fillet of 5.1 mm, for a tool of 5.25 mm with its stock)
N10 G00 X-10 Y0 F1000
N20 V.G.WZ_AKT.R = 0
N30 G41 G01 X0 Y0
N40 X50
N50 G03 X50.1 Y0.1 I0 J0.1
N60 G01 Y50
N70 G40 X0
