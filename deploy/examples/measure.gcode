(Measures the workpiece of measure.textproto, and sets G54 to its corner and its top)
G21 G90 G94
G0 X50 Y30
G0 Z25                                              (beside the corner)
o<measure_corner> call [10] [10] [8] [2] [60] [1] [0] [1]
G0 G53 Z60
G0 G53 X95 Y100                                     (above the block)
G38.2 Z20 F300 P0
#<top> = #5063
G0 G53 Z60
G10 L20 P1 Z[#5422 - #<top>]
G0 G53 X90 Y76
G0 G53 Z25                                          (in the bore)
o<measure_bore> call [25] [2] [60] [1] [0] [0]
G0 G53 Z60
G0 G53 X170 Y60
G0 G53 Z35                                          (above the boss)
o<measure_boss> call [20] [10] [5] [2] [60] [1] [0] [0]
G0 G53 Z60
M2
