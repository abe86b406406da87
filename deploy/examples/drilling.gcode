%
(drilling.gcode: the same holes in two pieces of work, by canned cycles, for three-axis.textproto; home the mill first.)

o<holes> sub (in the coordinate system in use)
  G0 X0 Y0
  G99 G81 X5 Y5 Z-2 R1 F1200 (to R between the holes)
  X25
  G91 G81 X-5 Y10 Z-3 R0 L3 (three more in a row, by steps)
  G90 G98 G83 X5 Y25 Z-5 R1 Q2 (a deep one, chip by chip; then up to the height before)
  G82 X25 Y25 Z-1 R1 P0.1 (a countersink, with a dwell)
  G80
o<holes> endsub

G21 G90 G17 G94
G10 L2 P1 X20 Y20 Z30 (where each piece of work has its corner and its face)
G10 L2 P2 X140 Y60 Z28 R90
G54 G0 Z5
o<holes> call
G0 Z5
G55 (turned by 90 degrees)
o<holes> call
G0 Z5
G54

G28 Z10
G28
M2
%
