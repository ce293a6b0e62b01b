; tool 3 3
%
(bCNC outline)
G90 G21 G17
M6 T3
G0 Z3
S12000
M3
(Block-name: outline)
g0 x-10 y0
g1 z-1 f100
g42 d3
g1 x0 y0 f800
g1 x50
g3 x60 y10 i0 j10
g1 y40
g1 x0
g1 y0
g40
g1 x-10 y-10
g0 z3
M5
M2
%
