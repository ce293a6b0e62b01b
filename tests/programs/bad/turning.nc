; expect: 900018 at line 5
; setup: dialect fanuc
G21 G97 T0101
G0 X50. Z2.
G42 X20. Z0.
G1 Z-20. F0.2
