; expect: 900102 at line 8
N10 G00 X0 Y0 F1000
N20 V.G.WZ_AKT.R=5
N30 G237
N40 G41 G01 X20 Y20
N50 X60
N60 Y60
N70 G40 G05 X30 Y90
N99 M30 ; no deselection block could become an arc (D-151)
