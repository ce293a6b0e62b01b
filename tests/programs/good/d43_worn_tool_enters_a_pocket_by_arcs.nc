; setup: nominal_radius 5
; setup: wear -0.02
; A centre path: its own blocks are no walls for a tool that runs towards the part.
N5 G0 X0 Y0 F800
N6 G141
N7 #TRC [REMOVE_MASKED_BLOCKS=1]
N20 G41 G1 X-4 Y-11
N30 G3 X0 Y-15 I4 J0
N40 G1 X22
N50 G3 X25 Y-12 J3
N60 G1 Y12
N70 G3 X22 Y15 I-3
N80 G1 X-22
N90 G3 X-25 Y12 J-3
N100 G1 Y-12
N110 G3 X-22 Y-15 I3
N120 G1 X0
N130 G3 X4 Y-11 J4
N140 G40 G1 X0 Y0
M30
