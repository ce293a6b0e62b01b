; tool 1 5 1
; tool 1 4 2
; tool 2 3 1
; path -4 0 L; -4 40 L; 0 44 A; 60 44 L; 80 40 L; -20 -20 L; -3 0 L; -3 40 L; 0 43 A; 60 43 L; 80 40 L
; T2 fetches the next tool: the edge in the cut stays, and M6 chooses the first one of the next.
G71 G90 G17
T1 M6
D2
T2
G0 X-20 Y-20
G41 G1 X0 Y0 F300
Y40
X60
G40 X80
M6
G0 X-20 Y-20
G41 G1 X0 Y0 F300
Y40
X60
G40 X80
M30
