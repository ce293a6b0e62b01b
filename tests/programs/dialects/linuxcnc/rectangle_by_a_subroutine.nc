; radius 3
; path -3 0 L; -3 25 L; 0 28 A; 40 28 L; 43 25 A; 43 0 L; 40 -3 A; 0 -3 L; -15 0 L
o<rect> sub
  #<w> = #1
  #<h> = #2
  G41 D1 G1 X0 Y0 F500
  Y#<h>
  X#<w>
  Y0
  X0
  G40 X-15
o<rect> endsub
G21 G90 G17
T1 M6 G43
G0 X-15 Y-5 Z3
G1 Z-2 F100
o<rect> call [40] [25]
G0 Z3
M2
