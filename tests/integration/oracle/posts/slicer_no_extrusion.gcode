; generated as by a slicer, with the extruder's words removed
; layer_height = 0.2
; perimeters = 2
G21 ; set units to millimeters
G90 ; use absolute coordinates
G28 X0 Y0 ; park X and Y
G1 Z5 F5000 ; lift nozzle
;LAYER_CHANGE
;Z:0.2
G1 Z.2 F7800
G1 X98.349 Y97.624
;TYPE:Skirt/Brim
G1 F1800
G1 X99.021 Y97.011
G1 X99.732 Y96.442
G1 X100.4 Y96.02 ; corner (sharp)
G1 X101.1 Y95.85
G2 X103.4 Y96.3 I.8 J2.1
G1 F7800
G1 Z.4
G1 X102 Y98
G1 F1800
G3 X104 Y100 R2
G1 X98.349 Y97.624
M5
M2
; post_process =
; (this text is behind the end
