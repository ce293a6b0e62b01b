; radius 5
; refused 900003 line 5
0   BEGIN PGM 355 MM
2   TOOL DEF 1  L+0.000
                R+10.000
3   TOOL CALL 1 Z
              S 1000.000
4   L   X-20.000  Y-20.000
                    R0 F9999 M03
5   L   X+10.000  Y+10.000
                    RL F200 M
6   L   X+10.000  Y+90.000
                    RL F M
7   L   X-20.000  Y-20.000
                    R0 F9999 M
8   END PGM 355 MM
