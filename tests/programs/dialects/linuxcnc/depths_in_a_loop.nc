; radius 4
; path -4 0 L; -4 40 L; 0 44 A; 60 44 L; 64 40 A; 64 0 L; 60 -4 A; 0 -4 L; -20 0 L; -4 0 L; -4 40 L; 0 44 A; 60 44 L; 64 40 A; 64 0 L; 60 -4 A; 0 -4 L; -20 0 L
(depth in steps)
#<depth> = 4
#<step> = 2
#<z> = 0
G21 G90 G17 G40
T1 M6
G0 X-20 Y0 Z5
o100 while [#<z> LT #<depth>]
  #<z> = [#<z> + #<step>]
  G0 X-20 Y0
  G1 Z[-#<z>] F100
  G41 D1 G1 X0 Y0 F400
  G1 Y40.
  X60.
  Y0.
  X0.
  G40 G1 X-20
o100 endwhile
G0 Z20
M2
