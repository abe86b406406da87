; Eight motors on Olimex's iCE40HX8K-EVB; see olimex_hx8k.v.
INPUTS = 3                      ; limit switch below, above, home switch
DIGITAL = 1
ANALOG = 1
CLOCK_HZ = 50000000
TICK_CLOCKS = 2500
