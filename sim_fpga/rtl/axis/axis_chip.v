// All of one motor's hardware: the ticks, the device, and its pins.
module axis_chip #(
    parameter TICK_CLOCKS = 96, // the clocks of a tick
    parameter CLOCK_PS = 10417,
    parameter TIME_BITS = 10,   // of a pulse time
    parameter INPUTS = 8,
    parameter DIGITAL = 8,
    parameter ANALOG = 2,
    parameter OUTPUT_BITS = 5,
    parameter SEGMENT_BITS = 6,
    parameter CAPTURE_BITS = 8,
    parameter EVENT_BITS = 4
) (
    input clk,
    input [63:0] power_up,      // POWER_UP
    // The host, as in axis_device.v.
    input write,
    input [19:3] write_address,
    input [63:0] write_data,
    input [19:3] read_address,
    output [63:0] read_data,
    input hold,
    // The pins.
    input [INPUTS-1:0] input_pins,
    output step_pin,
    output direction_pin,
    output enable_pin,
    output reg [DIGITAL-1:0] digital_pins, // a tick after the tick of a change, as steps
    output [ANALOG-1:0] pwm_pins
);
    localparam [63:0] TICK_NS = (64'd500 + TICK_CLOCKS * CLOCK_PS) / 64'd1000;
    localparam [15:0] LAST_CLOCK = TICK_CLOCKS - 1;
    // A frame is read and checked before it begins: two clocks for each entry of a full ring, and 20.
    localparam [63:0] LEAD_TICKS = (2 * (1 << SEGMENT_BITS) + 20) / TICK_CLOCKS + 1;
    localparam [63:0] PIN_TICKS = 2;   // a tick, and 5 clocks
    reg [15:0] clock;
    reg tick;
    reg [INPUTS-1:0] first, second; // two registers each, because the pins belong to no clock
    initial {clock, tick, first, second} = 0;
    always @(posedge clk) begin
        clock <= tick ? 16'd0 : clock + 1'b1;
        tick <= clock == LAST_CLOCK - 1'b1;
        {second, first} <= {first, input_pins};
    end

    wire step, forward, enabled;
    wire [TIME_BITS-1:0] step_width, direction_setup, direction_hold;
    wire [2:0] inverted;
    // verilator lint_off UNUSED
    wire [15:0] digital, outputs_inverted;
    wire [15:0] digital_levels = digital ^ outputs_inverted;
    wire [127:0] analog;
    // verilator lint_on UNUSED
    wire [ANALOG*TIME_BITS-1:0] pwm_periods;
    // verilator lint_off PINCONNECTEMPTY
    axis_device #(.TICK_NS(TICK_NS), .TIME_UNIT_PS(CLOCK_PS), .TIME_BITS(TIME_BITS), .INPUTS(INPUTS),
        .DIGITAL(DIGITAL), .ANALOG(ANALOG), .OUTPUT_BITS(OUTPUT_BITS),
        .SEGMENT_BITS(SEGMENT_BITS), .CAPTURE_BITS(CAPTURE_BITS), .EVENT_BITS(EVENT_BITS),
        .LEAD_TICKS(LEAD_TICKS), .PIN_TICKS(PIN_TICKS)) device (.clk(clk),
        .tick(tick), .busy(), .first_tick(64'd0), .power_up(power_up), .write(write), .write_address(write_address),
        .write_data(write_data), .read_address(read_address), .read_data(read_data), .hold(hold), .pins(second),
        .step(step), .forward(forward), .enabled(enabled), .digital(digital),
        .outputs_inverted(outputs_inverted), .pwm_periods(pwm_periods), .analog(analog), .step_width(step_width),
        .direction_setup(direction_setup), .direction_hold(direction_hold), .inverted(inverted));
    // verilator lint_on PINCONNECTEMPTY
    axis_pins #(.TIME_BITS(TIME_BITS)) pins (.clk(clk), .tick(tick), .step(step), .forward(forward),
        .enabled(enabled), .step_width(step_width), .direction_setup(direction_setup),
        .direction_hold(direction_hold), .inverted(inverted), .step_pin(step_pin), .direction_pin(direction_pin),
        .enable_pin(enable_pin));

    initial digital_pins = 0;
    always @(posedge clk) if (tick) digital_pins <= digital_levels[DIGITAL-1:0];
    genvar n;
    generate for (n = 0; n < ANALOG; n = n + 1) begin : pwms
        axis_pwm #(.BITS(TIME_BITS)) pwm (.clk(clk), .period(pwm_periods[TIME_BITS*n +: TIME_BITS]),
            .level(analog[16*n +: 16]), .pin(pwm_pins[n]));
    end endgenerate
endmodule
