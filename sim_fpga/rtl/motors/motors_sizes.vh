// Made by assemble.py; edit program/*.asm.
parameter TICK_CLOCKS = 1920,
parameter INPUTS = 8,
parameter DIGITAL = 8,
parameter ANALOG = 2
