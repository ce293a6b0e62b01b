; block_skip leave_out
; radius 5
; path -5 0 L; -5 40 L; -20 60 L
0 BEGIN PGM A MM
1 TOOL CALL 1 Z S3000
2 L X-20 Y-20 R0 FMAX
/ 3 L M8
/4 L X+10 RL
5 L X+0 Y+0 RL F300
6 / L X+10 Y+20
7 L Y+40
8 L X-20 Y+60 R0
9 END PGM A MM
