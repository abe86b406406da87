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
    reg [BITS+15:0] product, addend;
    reg [15:0] factor;
    wire ends = at + 1'b1 >= period;
    initial {at, on, next_on, product, addend, factor, pin} = 0;
    always @(posedge clk) begin
        at <= ends ? {BITS{1'b0}} : at + 1'b1;
        if (ends) begin
            on <= next_on;
            product <= 0;
            addend <= {16'd0, period};
            factor <= level;
        end else begin
            if (factor[0]) product <= product + addend;
            addend <= addend << 1;
            factor <= factor >> 1;
            if (factor == 0) next_on <= product[BITS+14:15];
        end
        pin <= period != 0 && at < on;
    end
endmodule
