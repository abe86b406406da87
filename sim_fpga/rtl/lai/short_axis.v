// The short axis: follows the long one with the slope of the line, and changes its speed by one pulse per period at
// most.
//
// Source: Lai, Chien, Tsao, Section 3.3.2: the slope, Eq. (13), and the first compensation, Eqs. (14) and (15). The
// second one, Eqs. (16) and (17), is in two_axis_planner.v, which has the root. LaiShortAxis
// (core/methods/lai_planner.hpp) makes the same pulses.
//   ideal      the slope times the long axis's pulses, halves up: each pulse adds 2 * length to the error, and takes
//              2 * long_length away, with a pulse, whenever that is possible, without multiplication or division
module short_axis (
    input clk,
    input start,
    input [15:0] length,      // pulses, at most long_length; both do not change during a line
    input [15:0] long_length,
    input round_again,        // at the start of a period: rounds this period alone
    input share,              // the long axis makes a pulse
    input finish,             // the long axis has arrived
    input [7:0] v_max,        // at the finish
    input derivative,         // the first compensation
    output [7:0] wanted,      // pulses of this period
    input make,               // as many are made
    input [7:0] made,
    output arrived,
    output [15:0] remaining   // 0 if it has made too many
);
    reg [16:0] done, ideal;
    reg [17:0] error;
    reg [7:0] speed;
    wire [17:0] more = error + {1'b0, length, 1'b0};
    wire whole = more >= {1'b0, long_length, 1'b0};

    assign arrived = done >= {1'b0, length};
    assign remaining = arrived ? 0 : length - done[15:0];
    wire [16:0] behind = ideal - done;
    wire [7:0] follow = ideal < done ? 0 : behind > 255 ? 255 : behind[7:0];
    wire [7:0] end_speed = remaining < {8'd0, v_max} ? remaining[7:0] : v_max;
    wire [7:0] free = finish ? end_speed : follow;
    wire [7:0] least = speed == 0 ? 0 : speed - 1'b1;
    wire [7:0] most = speed == 255 ? 255 : speed + 1'b1;
    assign wanted = !derivative ? free : free < least ? least : free > most ? most : free;

    always @(posedge clk) begin
        if (start) begin
            done <= 0;
            ideal <= 0;
            error <= {2'b0, long_length};
            speed <= 0;
        end else if (round_again) begin
            ideal <= done;
            error <= {2'b0, long_length};
        end else if (share) begin
            error <= whole ? more - {1'b0, long_length, 1'b0} : more;
            if (whole) ideal <= ideal + 1'b1;
        end else if (make) begin
            done <= done + {9'd0, made};
            speed <= made;
        end
    end
endmodule
