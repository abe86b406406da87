// The velocity planner of a line: the pulses of both axes in each sampling period.
//
// Source: Lai, Chien, Tsao, Section 3.3 and Fig. 4. In the paper a soft-core 8051 does this; here it is a state
// machine, which takes at most some 800 clocks for a period. plan_two_axes() (core/methods/lai_planner.hpp) makes the
// same pulses.
module two_axis_planner (
    input clk,
    input reset,
    input line_valid,
    output line_taken,
    input [15:0] x,           // signed
    input [15:0] y,
    input [7:0] v_max,        // pulses per period, at least one
    input round_each,         // rounds each period by itself, as in Fig. 8, and not from the start of the line
    input derivative,         // the compensation of Eqs. (14) and (15)
    input limit_remaining,    // the compensation of Eqs. (16) and (17)
    output ready,             // the pulses of a period are valid, and stay so until they are taken
    input taken,
    output [7:0] x_pulses,
    output [7:0] y_pulses,
    output reg x_backward,
    output reg y_backward
);
    localparam IDLE = 0, TOP = 1, BEGIN = 2, PERIOD = 3, SHARE = 4, LIMIT = 5, MAKE = 6, READY = 7;
    reg [2:0] state;
    reg [15:0] long_length, short_length;
    reg x_leads, first, finish;
    reg [7:0] top, long_pulses, short_pulses, shares;

    wire [15:0] x_size = x[15] ? -x : x;
    wire [15:0] y_size = y[15] ? -y : y;
    assign line_taken = state == IDLE && line_valid;
    assign ready = state == READY;
    assign x_pulses = x_leads ? long_pulses : short_pulses;
    assign y_pulses = x_leads ? short_pulses : long_pulses;

    wire [7:0] root, next_pulses, wanted;
    wire root_ready, short_arrived;
    wire [15:0] long_left, short_left;
    wire long_arrived = long_left == 0;
    wire compensated = derivative || limit_remaining;
    wire over = long_arrived && (short_arrived || !compensated);
    wire next = state == PERIOD && !long_arrived;
    wire [7:0] made = limit_remaining ? root : wanted;
    // The limit makes the root the smaller one of both.
    whole_root square_root (
        .clk(clk), .start(first && (state == TOP || state == LIMIT)),
        .value(state == TOP ? long_length : short_left), .limit(state == TOP ? v_max : wanted),
        .ready(root_ready), .root(root));
    long_axis leader (
        .clk(clk), .start(state == BEGIN), .length(long_length), .top(top), .next(next), .pulses(next_pulses),
        .remaining(long_left));
    short_axis follower (
        .clk(clk), .start(state == BEGIN), .length(short_length), .long_length(long_length),
        .round_again(next && round_each), .share(state == SHARE && shares != 0), .finish(finish), .v_max(v_max),
        .derivative(derivative), .wanted(wanted), .make(state == MAKE), .made(made), .arrived(short_arrived),
        .remaining(short_left));
    always @(posedge clk) begin
        first <= 0;
        if (reset) state <= IDLE;
        else case (state)
            IDLE:
                if (line_valid && (x != 0 || y != 0)) begin
                    x_leads <= x_size >= y_size;
                    long_length <= x_size >= y_size ? x_size : y_size;
                    short_length <= x_size >= y_size ? y_size : x_size;
                    {x_backward, y_backward} <= {x[15], y[15]};
                    first <= 1;
                    state <= TOP;
                end
            TOP:
                if (!first && root_ready) begin
                    top <= root;
                    state <= BEGIN;
                end
            BEGIN: state <= PERIOD;
            PERIOD: begin
                finish <= long_arrived;
                long_pulses <= long_arrived ? 0 : next_pulses;
                shares <= long_arrived ? 0 : next_pulses;
                state <= SHARE;
            end
            SHARE:
                if (shares != 0) shares <= shares - 1'b1;
                else begin
                    first <= 1;
                    state <= LIMIT;
                end
            LIMIT:
                if (!first && root_ready) state <= MAKE;
            MAKE: begin
                short_pulses <= made;
                state <= READY;
            end
            default:
                if (taken) state <= over ? IDLE : PERIOD;
        endcase
    end
endmodule
