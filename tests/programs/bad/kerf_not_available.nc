; expect: 900102 at line 6
; KERF_MASKING changes the path, so it is refused where it would act.
N10 G00 X0 Y-20
N20 #TRC [KERF_MASKING=1]
N25 G141 V.G.WZ_AKT.R = 10
N30 G41 G01 X0 Y0 F1000
N40 X50
N50 G40 X0 Y80
N60 M30
