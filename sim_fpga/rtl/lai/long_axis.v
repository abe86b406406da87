// The long axis: how many pulses it makes in each sampling period. The speed rises by one pulse per period to V_max,
// and falls by one as soon as what remains is no more than the fall.
//
// Source: Lai, Chien, Tsao, Section 3.3.1, Eqs. (5) to (11), with V_0 = 0 and a = 1. LaiLongAxis
// (core/methods/lai_planner.hpp) with these two values makes the same pulses. The fall from speed v is
// v + (v - 1) + ... + 1, which changes by additions.
module long_axis (
    input clk,
    input start,
    input [15:0] length,      // pulses, at least one
    input [7:0] top,          // V_max, at most the root of the length, Eq. (10); at least one
    input next,               // a period: `pulses` are made
    output [7:0] pulses,
    output [15:0] remaining
);
    reg [15:0] left, fall;    // fall: the pulses that falling from `speed` makes
    reg [7:0] speed;
    reg falling;
    assign remaining = left;

    wire [15:0] higher_fall = fall + {8'd0, speed} + 16'd1;
    wire falls = falling || (speed != 0 && left <= fall);
    wire rises = !falls && speed < top; // with this top there is always room for the fall
    wire slows = falls && speed > 1;
    wire [7:0] next_speed = rises ? speed + 1'b1 : slows ? speed - 1'b1 : speed;
    assign pulses = left < {8'd0, next_speed} ? left[7:0] : next_speed;

    always @(posedge clk) begin
        if (start) begin
            left <= length;
            fall <= 0;
            speed <= 0;
            falling <= 0;
        end else if (next) begin
            left <= left - {8'd0, pulses};
            speed <= next_speed;
            fall <= rises ? higher_fall : slows ? fall - {8'd0, speed} : fall;
            falling <= falls;
        end
    end
endmodule
