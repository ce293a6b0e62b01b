; expect: 90017 at line 10
; (D-16: the bisector of the notch runs into the end of N50. Raised up to there nothing of N50
; is left, not even a direction to stay beside: the notch stays as it is)
N10 G00 X1.8 Y-2.4 F1000
N20 V.G.WZ_AKT.R = 1
N30 G138 G26 G140 G161
#TRC[KERF_MASKING=1]
N35 G41 G01 X0 Y0
N40 X-3 Y0
N50 G03 X-2 Y-1 I-2 J0
N60 G40 G01 X0.4 Y0.8
N70 M30
