; tool 3 2
; path -2 -15 L; -2 40 L; 0 42 A; 40 42 L; 42 40 A; 42 -15 L; -20 -15 L
G21 G90 G17 G40
T3 M6 G43
msg "outline, tool 3"
DlgMsg "Clamps away?"
LogFile "parts.txt" 1
G0 X-20 Y-15 Z5
G38.2 Z-10 F50
G0 Z2
G1 Z-2 F100
G41 D3 X0 F400
LogMsg "left side"
Y40
X40
Y-15
G40 X-20
M2
