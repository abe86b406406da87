(Measures the heights of the plate of crooked-plate.textproto, at 7 by 7 points)
G21 G90 G94
G0 Z60
G0 X70 Y50
G0 Z34
o<measure_surface> call [10] [7] [10] [7] [8] [60] [0.5] [0]
G0 Z60
M2
