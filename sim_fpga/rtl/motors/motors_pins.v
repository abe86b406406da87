// The pins of the motors: step, direction and enable of each, and its digital outputs. The core may execute a tick
// until the end of the one behind it. So what it finds for a tick is at the pins from the second tick on behind it, and
// the time from a tick to its edges does not depend on the core's work.
//
// A pulse begins DIRECTION_SETUP after the tick and lasts STEP_WIDTH; the direction changes with the tick. Times are in
// units of 8 clocks: in each clock one of the motors is looked at. Two times must fit into a tick (LONGEST_TIME). Then
// the pause behind a pulse is as long as the pulse, and DIRECTION_HOLD is kept.
module motors_pins #(
    parameter MOTORS = 8,       // at most 8
    parameter MOTOR_BITS = 3,
    parameter DIGITAL = 8
) (
    input clk,
    input tick,                 // for one clock: a tick begins
    input take,                 // for one clock: the core begins to execute a tick, and has executed the one before it
    // Of this motor, each for one clock.
    input [MOTOR_BITS-1:0] motor,
    input step_forward,
    input step_backward,
    input set_levels,
    input set_enable,           // {inverted enable, direction, step, enabled}
    input set_times,            // {end, begin} of a pulse
    input [15:0] data,
    output reg [MOTORS-1:0] step_pins,
    output reg [MOTORS-1:0] direction_pins,
    output reg [MOTORS-1:0] enable_pins,
    output reg [DIGITAL*MOTORS-1:0] digital_pins
);
    // The core's orders, delayed by a clock, because the way from its instruction to all pins is long.
    reg [MOTOR_BITS-1:0] its_motor;
    reg makes_step, is_forward, taken, its_levels, its_enable, its_times;
    reg [15:0] its_data;
    initial {its_motor, makes_step, is_forward, taken, its_levels, its_enable, its_times, its_data} = 0;
    always @(posedge clk) begin
        {its_motor, makes_step, is_forward, taken} <= {motor, step_forward || step_backward, step_forward, take};
        {its_levels, its_enable, its_times, its_data} <= {set_levels, set_enable, set_times, data};
    end

    (* no_rw_check *) reg [15:0] times[0:255];
    reg [15:0] found;           // of the motor `seen`
    reg [2:0] at, seen;
    reg [7:0] unit;             // since the tick
    reg began;                  // the tick, a clock ago: `seen` is still of the one before
    integer i;
    initial begin
        {at, seen, unit, began, found} = 0;
        for (i = 0; i < 256; i = i + 1) times[i] = 16'h0c00;
    end
    always @(posedge clk) begin
        if (its_times) times[{5'd0, its_motor}] <= its_data;
        found <= times[{5'd0, at}];
        seen <= at;
        at <= tick ? 3'd0 : at + 1'b1;
        began <= tick;
        if (tick) unit <= 0;
        else if (seen == 7 && !began && unit != 8'hff) unit <= unit + 1'b1;
    end
    wire begins = unit == found[7:0], ends = unit == found[15:8];

    genvar n;
    generate for (n = 0; n < MOTORS; n = n + 1) begin : motors
        reg has_stepped, went_forward, will_step, will_go_forward, steps, is_on, goes_forward, is_enabled;
        reg [2:0] inverted;
        reg [DIGITAL-1:0] levels, next_levels;
        wire is_this = its_motor == n;
        initial {has_stepped, went_forward, will_step, will_go_forward, steps, is_on, goes_forward, is_enabled} = 0;
        initial {inverted, levels, next_levels} = 0;
        always @(posedge clk) begin
            if (is_this && makes_step) {has_stepped, went_forward} <= {1'b1, is_forward};
            else if (taken) has_stepped <= 0;
            if (taken) {will_step, will_go_forward, next_levels} <= {has_stepped, went_forward, levels};
            else if (tick) will_step <= 0;
            if (tick) begin
                steps <= will_step;
                if (will_step) goes_forward <= will_go_forward;
            end
            if (seen == n) is_on <= (is_on || (begins && steps)) && !ends;
            if (is_this && its_enable) {inverted, is_enabled} <= its_data[3:0];
            if (is_this && its_levels) levels <= its_data[DIGITAL-1:0];
            step_pins[n] <= is_on ^ inverted[0];
            direction_pins[n] <= goes_forward ^ inverted[1];
            enable_pins[n] <= is_enabled ^ inverted[2];
            if (tick) digital_pins[DIGITAL*n +: DIGITAL] <= next_levels;
        end
    end endgenerate
    initial {step_pins, direction_pins, enable_pins, digital_pins} = 0;
endmodule
