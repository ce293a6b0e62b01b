; tool 1 5
; path -5 0 L; -5 40 L; 0 45 A; 40 45 L; 45 40 A; 45 0 L; 40 -5 A; -10 -5 L; -20 -20 L; -5 0 L; -5 40 L; 0 45 A; 40 45 L; 45 40 A; 45 0 L; 40 -5 A; -10 -5 L; -20 -20 L; -5 0 L; -5 40 L; 0 45 A; 40 45 L; 45 40 A; 45 0 L; 40 -5 A; -10 -5 L; -20 -20 L
o<kontur> sub
  g1 z[#1] f100
  g41 d1 g1 x0 y0 f300
  y40
  x40
  y0
  x-10
  g40 x-20 y-20
o<kontur> endsub
g21 g90 g17 g40
t1 m6
g43 h1
m3 s1000
g0 x-20 y-20 z5
#<z> = -2
o100 while [#<z> ge -6]
  o<kontur> call [#<z>]
  #<z> = [#<z> - 2]
o100 endwhile
g0 z20
m2
