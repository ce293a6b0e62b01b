; expect: 900102 at line 3
(D-15: compensation while the machine moves is not offered)
N10 #TRC[ONLINE=1 INVERSE=1]
N20 G00 X0 Y0
N30 M30
