// The DDA: spreads the pulses of a sampling period evenly over its 256 clocks.
//
// Source: C.-K. Lai, W.-N. Chien, Y.-T. Tsao, "An FPGA-Based Multiple-Axis Velocity Controller and Stepping Motors
// Drives Design", Fig. 3: an adder and two registers of 8 bits. A carry is a pulse. core/methods/lai_dda.hpp is the
// same in C++.
module dda (
    input clk,
    input reset,
    input load,               // at the end of a period, with its last clock or later
    input [7:0] pulses,       // of the next period
    input clock,              // one of 256 of a period
    output reg pulse          // in the clock after it
);
    reg [7:0] increment, sum;
    wire [8:0] next = {1'b0, sum} + {1'b0, increment};
    always @(posedge clk) begin
        pulse <= clock && next[8] && !reset;
        if (reset) begin
            increment <= 0;
            sum <= 0;
        end else begin
            if (load) increment <= pulses;
            if (clock) sum <= next[7:0];
        end
    end
endmodule
