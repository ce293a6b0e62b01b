; expect: 90019 at line 9
; (D-09: N80 sticks out of the wall towards the tool. On from N60 to N110 in one line the tool would
; cut it off; without REMOVE_MASKED_BLOCKS there is no other joint)
N10 G00 X-20 Y-20 F1000
N20 V.G.WZ_AKT.R = 3
N30 G138 G26 G141
N40 G42 G01 X0 Y0
N60 X20
N70 Y-1
N80 X24
N90 Y0
N110 X50
N120 G40 G01 X60 Y-20
N130 M30
