; radius 2
; path -2 0 L; -2 40 L; -20 40 L
G17 G90 G71
R[1]=-20
R[2]=R1/5
G0 X=R[1] Y=R[2]+4 Z1
T1 D1
G41 G1 X0 Y0 F300
Y=-2*R[1]
G40 X=R1
M30
