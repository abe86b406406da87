; Five motors on the iCEBreaker, which has no more pins; see icebreaker.v.
INPUTS = 1                      ; a switch, for a limit, for home, or for both
DIGITAL = 0
ANALOG = 0
CLOCK_HZ = 42000000
TICK_CLOCKS = 1680
