; tool 5 5 1 MILL_10
; tool 5 4 2 MILL_10
; path -4 0 L; -4 50 L; -30 50 L; -30 -30 L; -5 0 L; -5 50 L; -30 50 L
; The index 1 of a tool, then the tool by its name.
0 BEGIN PGM A MM
1 TOOL CALL 5.1 Z S1000
2 L X-30 Y-30 R0 FMAX
3 L X+0 Y+0 RL F500
4 L Y+50
5 L X-30 R0
6 TOOL CALL "Mill_10" Z S1000
7 L X-30 Y-30 R0 FMAX
8 L X+0 Y+0 RL F500
9 L Y+50
10 L X-30 R0 M30
11 END PGM A MM
