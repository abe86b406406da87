%
(pocket.gcode: a round pocket and a slot, by arcs and a subroutine, for three-axis.textproto; home the mill first.)
(A tool of 6 mm: every ring goes 2 mm beside the last one.)

o<ring> sub (#1: the radius; #2: the depth. One turn down, one turn at depth)
  G1 X#1 Y0 F3600
  G3 X#1 Y0 Z-#2 I-#1 F1800
  G3 X#1 Y0 I-#1 F3600
o<ring> endsub

G21 G90 G17 G94
G10 L2 P1 X60 Y60 Z20 (the work's zero: the pocket's centre, and the face of the work)
G54
G0 Z3
G0 X0 Y0
G1 Z0 F900

(The pocket: three rings to each depth, 1 mm and 2 mm)
#<depth> = 1
o100 while [#<depth> le 2]
  #<radius> = 2
  o110 repeat [3]
    o<ring> call [#<radius>] [#<depth>]
    #<radius> = [#<radius> + 2]
  o110 endrepeat
  G1 X0 Y0 F3600
  #<depth> = [#<depth> + 1]
o100 endwhile
G0 Z3

(A slot with round ends, by radius, 40 mm above the pocket)
G52 Y40
G0 X-10 Y-4
G1 Z-1 F900
G1 X10 F3600
G3 X10 Y4 R4
G1 X-10
G3 X-10 Y-4 R4
G0 Z3
G52 Y0

G28 Z3 (to the park position: first Z, then all)
G28
M2
%
