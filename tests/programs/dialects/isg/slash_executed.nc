; block_skip execute
; radius 5
; path -5 0 L; -5 40 L; -20 60 L
N05 G138
N10 G0 X-20 Y-20
/N20 M8
/2 N30 G41 G1 X0 Y0 F300
/N40 Y40
N50 G40 X-20 Y60
N60 M30
