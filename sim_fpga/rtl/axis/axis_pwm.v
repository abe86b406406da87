// A pin that is on for a part of each period: level / 2^15 of it, rounded down to a clock. A period lasts at least 18
// clocks, and shows the level that there was when the one before it began, because a multiplication takes 16 clocks.
module axis_pwm #(
    parameter BITS = 16
) (
    input clk,
    input [BITS-1:0] period,    // in clocks; 0: the pin stays off
    input [15:0] level,         // up to 2^15
    output reg pin
);
    reg [BITS-1:0] at;          // the clock of the period
    reg [BITS-1:0] on, next_on; // for so many clocks
    reg [BITS:0] product;       // of the bits of the level so far
    reg [16:0] factor;          // the other bits, behind a 1
    wire [BITS:0] sum = product + (factor[0] ? {1'b0, period} : {(BITS + 1){1'b0}});
    wire ends = at + 1'b1 >= period;
    initial {at, on, next_on, product, factor, pin} = 0;
    always @(posedge clk) begin
        at <= ends ? {BITS{1'b0}} : at + 1'b1;
        if (ends) begin
            on <= next_on;
            product <= 0;
            factor <= {1'b1, level};
        end else if (factor[16:1] != 0) begin
            product <= sum >> 1;
            factor <= factor >> 1;
            if (factor[16:1] == 1) next_on <= sum[BITS-1:0]; // the bit 2^15
        end
        pin <= period != 0 && at < on;
    end
endmodule
