; Three motors behind an SPI, for a simulation in real time; see sim_fpga/rtl/boards.
INPUTS = 3                      ; limit switch below, above, home switch
DIGITAL = 1
ANALOG = 1
CLOCK_HZ = 2500000
TICK_CLOCKS = 800
LEAD_TICKS = 140                ; of 112 entries for frames, of which one is checked in a tick, and 24 changes of outputs
