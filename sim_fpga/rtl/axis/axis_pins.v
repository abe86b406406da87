// The pins of a motor. A step of a tick becomes a pulse a constant time after the beginning of the next tick:
// DIRECTION_SETUP and 5 clocks. So a change of direction, which is known at that beginning, can come in time before it.
//
// If the host's steps leave less time than the driver needs, which is the width twice between two steps, and hold and
// setup between two of different directions, a pulse comes late, but the driver's times are kept, and no step is lost.
// Times are in clocks.
module axis_pins #(
    parameter TIME_BITS = 10,
    parameter QUEUE_BITS = 5,   // 2 to the power of it is the number of steps that can wait
    parameter [TIME_BITS-1:0] OWN_WIDTH = 96
) (
    input clk,
    input tick,                 // for one clock: a tick begins
    input step,                 // for one clock: a step of this tick
    input forward,
    input enabled,
    input [TIME_BITS-1:0] step_width, // of a pulse, and of the pause after it; 0: OWN_WIDTH
    input [TIME_BITS-1:0] direction_setup, // from a change of direction to a pulse
    input [TIME_BITS-1:0] direction_hold, // from the beginning of a pulse to a change of direction
    input [2:0] inverted,       // step, direction, enable
    output reg step_pin,
    output reg direction_pin,
    output reg enable_pin
);
    localparam [TIME_BITS+1:0] LATENCY = 3; // from the queue's input to its output
    (* no_rw_check *) reg [TIME_BITS+2:0] queue[0:(1 << QUEUE_BITS)-1]; // {forward, when}
    reg [QUEUE_BITS-1:0] head, tail;
    reg [TIME_BITS+1:0] clocks;
    reg is_waiting, waits_forward; // a step of this tick
    reg is_shown;               // the oldest step is in these
    reg goes_forward;
    reg [TIME_BITS+1:0] due;
    reg is_on, direction;       // a pulse, and the direction of the motor
    reg [TIME_BITS-1:0] width_left, setup_left, hold_left; // clocks of the pulse or its pause, and until it may go on
    reg is_pause;

    wire [TIME_BITS-1:0] width = step_width == 0 ? OWN_WIDTH : step_width;
    wire [TIME_BITS+1:0] after_due = clocks - due;
    wire is_due = !after_due[TIME_BITS+1];
    wire is_free = !is_on && !is_pause;
    wire turns = is_shown && goes_forward != direction && hold_left == 0 && !is_on;
    wire begins = is_shown && goes_forward == direction && is_due && is_free && setup_left == 0;

    initial begin
        {head, tail, clocks, is_waiting, waits_forward, is_shown, goes_forward, due, is_on, direction} = 0;
        {width_left, setup_left, hold_left, is_pause, step_pin, direction_pin, enable_pin} = 0;
    end
    always @(posedge clk) begin
        if (tick && is_waiting) queue[head] <= {waits_forward, clocks + {2'd0, direction_setup} + LATENCY};
        {goes_forward, due} <= queue[tail];
    end
    always @(posedge clk) begin
        clocks <= clocks + 1'b1;
        if (step) waits_forward <= forward;
        if (step || tick) is_waiting <= step;
        if (tick && is_waiting) head <= head + 1'b1;
        is_shown <= head != tail && !begins;
        if (begins) tail <= tail + 1'b1;

        if (turns) direction <= goes_forward;
        setup_left <= turns ? direction_setup : setup_left - {{(TIME_BITS - 1){1'b0}}, setup_left != 0};
        hold_left <= begins ? direction_hold : hold_left - {{(TIME_BITS - 1){1'b0}}, hold_left != 0};
        if (begins) begin
            is_on <= 1;
            width_left <= width - 1'b1;
        end else if (width_left != 0) begin
            width_left <= width_left - 1'b1;
        end else begin
            is_on <= 0;
            is_pause <= is_on;
            if (is_on) width_left <= width - 1'b1;
        end
        step_pin <= is_on ^ inverted[0];
        direction_pin <= direction ^ inverted[1];
        enable_pin <= enabled ^ inverted[2];
    end
endmodule
