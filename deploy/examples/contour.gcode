%
(contour.gcode: the outline of a plate of 80 x 50 mm with three round corners, for three-axis.textproto; home the mill first.)
(G41.1 guides the tool its radius beside the outline; a D of 5.9 leaves it 0.05 mm smaller.)

G21 G90 G17 G94 G61
G10 L2 P3 X40 Y50 Z20 R0
G56
G0 Z3
G0 X-15 Y-15
#<depth> = 0.5
o100 repeat [2]
  G1 Z-#<depth> F900
  G42.1 D6 (on the right of the way, which goes counterclockwise around the plate: outside)
  G1 X0 Y0 F3000
  G1 X70
  G3 X80 Y10 R10
  G1 Y40
  G3 X70 Y50 I-10 J0
  G1 X10
  G3 X0 Y40 I0 J-10
  G1 Y-10
  G40
  G0 X-15 Y-15
  #<depth> = [#<depth> + 0.5]
o100 endrepeat
G0 Z3

(Two notches in the far edge, as splines)
G92 X0 Y0 (zero is where the tool stands now)
#<x> = 35
o200 repeat [2]
  G0 X#<x> Y65
  G1 Z-0.5 F900
  G5 I0 J-8 P0 Q-8 X[#<x> + 12] Y65 F2400
  G0 Z3
  #<x> = [#<x> + 28]
o200 endrepeat
G92.1

G28 Z5
G28
M2
%
