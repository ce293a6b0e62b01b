; D-176: a list in columns, the feed and M of a block on the line below
; radius 10
; path 0 10 L; 0 90 L; 10 100 A; 90 100 L; 100 90 A; 100 10 L; 90 0 A; 10 0 L; -20 -20 L
0   BEGIN PGM 355 MM
1   BLK FORM 0.1 Z  X+0.000
                    Y+0.000  Z-20.000
2   BLK FORM 0.2    X+100.000
                    Y+100.000  Z+0.000
3   TOOL DEF 1  L+0.000
                R+10.000
4   TOOL CALL 1 Z
              S 1000.000
5   L   X-20.000  Y-20.000
                    R0 F9999 M03
6   L   Z-10.000
                    R0 F9999 M
7   L   X+10.000
                    Y+10.000
                    RL F200 M
8   L   X+10.000  Y+90.000
                    RL F M
9   L   X+90.000  Y+90.000
                    RL F M
10  L   X+90.000  Y+10.000
                    RL F M
11  L   X+10.000  Y+10.000
                    RL F M
12  L   X-20.000  Y-20.000
                    R0 F9999 M
13  L   Z+50.000
                    R0 F9999 M02
14  END PGM 355 MM
