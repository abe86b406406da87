( pcb2gcode 2.4.0 )
( Software-independent Gcode )

G94 ( Millimeters per minute feed rate. )
G21 ( Units == Millimeters. )

G90 ( Absolute coordinates.        )
G00 S20000 ( RPM spindle speed.           )

G64 P0.00254 ( set maximum deviation from commanded toolpath )
G01 F300.00000 ( Feedrate. )

G00 Z2.00000 ( retract )

M3 ( Spindle on clockwise.        )
G04 P0 ( dwell for no time -- G64 should not smooth over this point )

( Piece #1, position 0;0 )
#5001=0 #5002=-0.1
G00 X10.16040 Y5.08110 ( rapid move to begin. )
G01 Z#5002 F100.00000
G04 P0 ( dwell for no time -- G64 should not smooth over this point )
G01 F300.00000
X10.92200 Y5.08110
X11.09370 Y5.15222
X[11.16482+#5001] Y[5.32393+#5001]
X11.16482 Y6.60087
X10.16040 Y5.08110
G04 P0 ( dwell for no time -- G64 should not smooth over this point )
G00 Z2.000

o102 sub ( probe-less drill )
G81 R#1 Z#2 F100. X#3 Y#4
o102 endsub
o102 call [1] ( height ) [-1.8] [12.7] [3.81]
G80
M5 ( Spindle off. )
M9 ( Coolant off. )
M2 ( Program end. )
