; LinuxCNC: a bolt circle and a facing subroutine
G21 G17 G40 G49 G54 G64 P0.02 Q0.01 G80 G90 G94
#<_clear> = 5 (safe height)
#<holes> = 6
#1 = 20 #2 = 30 #3 = 25
o<bolt_circle> sub (x, y, radius, holes)
  #<i> = 0
  o110 while [#<i> LT #4]
    #<a> = [360 / #4 * #<i>]
    G0 X[#1 + #3 * COS[#<a>]] Y[#2 + #3 * SIN[#<a>]]
    G81 Z-3 R2 F120
    #<i> = [#<i> + 1]
  o110 endwhile
  G80
o<bolt_circle> endsub [#<i>]
o<face> sub
  o120 if [EXISTS[#<_passes>] AND EXISTS[#5]]
    o125 repeat [#<_passes>]
      G1 X60 F800
      G91
      Y2
      G90
      G1 X0
      G91
      Y2
      G90
    o125 endrepeat
  o120 else
    o125 repeat [1]
      G1 X60 F400
    o125 endrepeat
  o120 endif
o<face> endsub
G0 Z#<_clear>
o<bolt_circle> call [#1] (centre) [#2] [#3] (count) [#<holes>]
(debug, #<_value> holes)
G0 X0 Y-5
#<_passes> = 3
o<face> call (with passes) [1]
#<_part> = 0
o200 do
  o[210 + #<_part>] if [#<_part> EQ 0]
    #<sub> = 300
  o[210 + #<_part>] else
    #<sub> = 301
  o[210 + #<_part>] endif
  o#<sub> call [#<_part> * 10]
  #<_part> = [#<_part> + 1]
o200 while [#<_part> LT 2]
M2
o300 sub
  G2 X[#1 + 10] Y0 R8 F300
o300 endsub
o301 sub
  G3 X#1 Y10 I-5 J5 F300
o301 endsub
