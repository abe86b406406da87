(Exported by FreeCAD)
(Post Processor: linuxcnc_post)
(Output Time:2022-03-06 10:11:12)
(begin preamble)
G17 G54 G40 G49 G80 G90
G21
(begin operation: Fixture)
(machine units: mm/min)
G54
(finish operation: Fixture)
(begin operation: Profile)
(machine units: mm/min)
(Compensated Tool Path: 1.5)
G0 Z5.000
G0 X-1.500 Y0.000
G0 X-1.500 Y0.000 Z3.000
G1 X-1.500 Y0.000 Z-1.000 F60.000
G2 X0.000 Y-1.500 Z-1.000 I1.500 J0.000 F240.000
G1 X50.000 Y-1.500 Z-1.000
G3 X51.500 Y0.000 Z-1.000 I0.000 J1.500
G1 X51.500 Y30.000 Z-1.000
G3 X50.000 Y31.500 Z-1.000 I-1.500 J-0.000
G1 X0.000 Y31.500 Z-1.000
G3 X-1.500 Y30.000 Z-1.000 I-0.000 J-1.500
G1 X-1.500 Y0.000 Z-1.000
G0 X-1.500 Y0.000 Z5.000
(finish operation: Profile)
(begin postamble)
M05
G17 G54 G90 G80 G40
M2
