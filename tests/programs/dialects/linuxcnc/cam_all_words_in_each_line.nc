; radius 3
(Exported by FreeCAD)
(Post Processor: linuxcnc_post)
(Output Time:2026-11-25 10:00:00)
(begin preamble)
G17 G54 G40 G49 G80 G90
G21
(begin operation: Fixture)
G54
(finish operation: Fixture)
(begin operation: TC: 6mm_Endmill001)
( TC: 6mm_Endmill001 )
M5
M6 T1
G43 H1
M3 S12000
(finish operation: TC: 6mm_Endmill001)
(begin operation: Profile)
G0 Z8.000
G0 X-10.000 Y20.000
G0 Z5.000
G1 X-10.000 Y20.000 Z-2.000 F300.000
G41 D1
G1 X0.000 Y20.000 Z-2.000 F600.000
G1 X0.000 Y40.000 Z-2.000 F600.000
G2 X10.000 Y50.000 Z-2.000 I10.000 J0.000 K0.000 F600.000
G1 X60.000 Y50.000 Z-2.000 F600.000
G1 X60.000 Y0.000 Z-2.000 F600.000
G1 X0.000 Y0.000 Z-2.000 F600.000
G1 X0.000 Y25.000 Z-2.000 F600.000
G40
G1 X-10.000 Y25.000 Z-2.000 F600.000
G0 Z8.000
(finish operation: Profile)
(begin postamble)
M05
G17 G54 G90 G80 G40
M2
