(Sets Z0 of the work with a touch plate of 12 mm, for probe.textproto)
G21 G90 G94
G91
G38.2 Z-60 F300      (down to the plate, fast)
G0 Z2                (off it again)
G38.2 Z-4 F60        (and slowly, for the exact place)
G90
G10 L20 P1 Z[12 + #5422 - #5063]   (the touch is 12 mm above the work: G54 Z0)
G0 Z20               (clear of the plate; take it away)
M2
