; radius 5
; path -5 0 L; -5 40 L; -20 60 L
0 BEGIN PGM A MM
;CAM FILE  -~
 D:\PARTS\PLATE.M~
CX-9
; ~~~~~~
1 TOOL CALL 1 Z S3000
; ~~~~
L X-20 Y-20 R0 FMAX
3 ; A ~
 B ~
4 L X+0 Y+0 RL F300
6 L Y+40
7 L X-20 Y+60 R0
8 END PGM A MM
; behind the end ~
