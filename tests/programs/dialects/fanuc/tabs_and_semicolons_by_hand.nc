; radius 5
; path -5 0 L; -5 45 L; 45 45 L; 45 -5 L; -10 -5 L; -20 -20 L
%;
O0024;	
N1	G21 G17 G90 G40;
N2	T1 M6;
N3	G54 G0 X-20.  Y-20. S1000 M3;   
N4	G43 H1 Z5.;
N5	G1 Z-2. F100;
N6	G41 D1 X0 Y0 F200;	(EIN)
N7	Y40.;
N8	X40.;
N9	Y0;
N10	X-10.;
N11	G40 X-20. Y-20.;
N12	G0 Z50.;
N13	M30;
%
