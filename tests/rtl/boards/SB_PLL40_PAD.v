// The PLL of an iCE40, as far as a simulation needs it: PACKAGEPIN has the clock that the PLL would make.
module SB_PLL40_PAD #(
    // verilator lint_off UNUSED
    parameter FEEDBACK_PATH = "SIMPLE",
    parameter [3:0] DIVR = 0,
    parameter [6:0] DIVF = 0,
    parameter [2:0] DIVQ = 0,
    parameter [2:0] FILTER_RANGE = 0
    // verilator lint_on UNUSED
) (
    input PACKAGEPIN,
    input RESETB,
    input BYPASS,
    output LOCK,
    output PLLOUTCORE
);
    assign LOCK = RESETB && !BYPASS;
    assign PLLOUTCORE = PACKAGEPIN;
endmodule
