; radius 3
; path -3 0 L; -3 30 L; 30 63 A; 70 63 L; 72.1213 62.1213 A; 92.1213 42.1213 L; 93 40 A; 93 10 L; 80 -3 A; 0 -3 L; 0 -20 L
; profile
g21 ; mm
g90 ; absolute
t1 m6 ; tool
g0 x-20 y0 z5 ; start
g1 z-2 f100 ; down
g41 d1 x0 y0 f300 ; on
G1 Y30 ; 0
G2 X30 Y60 I30 J0 ; 1
G1 X70 ; 2
X90 Y40 ; 3
Y10 ; 4
G2 X80 Y0 I-10 J0 ; 5
G1 X0 ; 6
g40 x0 y-20 ; off
g0 z10
m2 ; end
