; tool 1 3
; path -3 0 L; -3 30 L; 0 33 A; 40 33 L; 43 30 A; 43 0 L; 40 -3 A; 0 -3 L; -12 -10 L
; a plate, by hand
g21 g17 g90 g40 g49 g64 p0.01
t1 m6 g43
m3 s2400
g0 x-10 y-10 z2
g1 z-1 f100
g41 g1 x0 y0 f400
g1 y30
x40
y0
x0
g40 g1 x-12 y-10
g0 z20
m5
m2
