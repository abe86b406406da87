// All hardware of several motors: the ticks, their devices, and their pins.
module motors_chip #(
    parameter MOTORS = 8,
    parameter MOTOR_BITS = 3,
    parameter HAS_MEMORY = 1,   // 0: the memory is outside
    `include "rtl/motors/motors_sizes.vh" // the clocks of a tick; inputs and outputs of each motor
) (
    input clk,
    // The host, as in motors_device.v.
    input write,
    input read,
    input [MOTOR_BITS-1:0] host_motor,
    input [19:1] host_address,
    input [63:0] write_data,
    output written,
    output was_read,
    output [15:0] read_data,
    input show,
    output shows,
    // The memory, if it is outside, as in motors_device.v.
    output memory_writes,
    output [MOTOR_BITS+12:0] memory_address,
    output [15:0] memory_data,
    input [15:0] memory_word,
    // The pins.
    input [INPUTS*MOTORS-1:0] input_pins,
    output [MOTORS-1:0] step_pins,
    output [MOTORS-1:0] direction_pins,
    output [MOTORS-1:0] enable_pins,
    output [DIGITAL*MOTORS-1:0] digital_pins,
    output [ANALOG*MOTORS-1:0] analog_pins
);
    localparam [15:0] LAST_CLOCK = TICK_CLOCKS - 1;
    reg [15:0] clock;
    reg tick;
    reg [INPUTS*MOTORS-1:0] first, second; // two registers each, because the pins belong to no clock
    initial {clock, tick, first, second} = 0;
    always @(posedge clk) begin
        clock <= tick ? 16'd0 : clock + 1'b1;
        tick <= clock == LAST_CLOCK - 1'b1;
        {second, first} <= {first, input_pins};
    end

    wire [15*MOTORS-1:0] pins;
    genvar n;
    generate for (n = 0; n < MOTORS; n = n + 1) begin : motors
        assign pins[15*n +: 15] = {{(15 - INPUTS){1'b0}}, second[INPUTS*n +: INPUTS]};
    end endgenerate
    wire [MOTOR_BITS-1:0] motor;
    wire take, step_forward, step_backward, set_levels, set_enable, set_times, set_analog;
    wire [15:0] data;
    // verilator lint_off PINCONNECTEMPTY
    // verilator lint_off UNUSED
    wire [2:0] channel;
    // verilator lint_on UNUSED
    motors_device #(.MOTORS(MOTORS), .MOTOR_BITS(MOTOR_BITS), .HAS_MEMORY(HAS_MEMORY)) device (.clk(clk), .tick(tick),
        .busy(), .take(take), .write(write), .read(read), .host_motor(host_motor), .host_address(host_address),
        .write_data(write_data), .written(written), .was_read(was_read), .read_data(read_data), .show(show),
        .shows(shows), .memory_writes(memory_writes), .memory_address(memory_address), .memory_data(memory_data),
        .memory_word(memory_word), .pins(pins), .motor(motor),
        .step_forward(step_forward), .step_backward(step_backward), .set_levels(set_levels), .set_enable(set_enable),
        .set_times(set_times), .set_analog(set_analog), .channel(channel), .data(data));
    // verilator lint_on PINCONNECTEMPTY
    motors_pins #(.MOTORS(MOTORS), .MOTOR_BITS(MOTOR_BITS), .DIGITAL(DIGITAL)) motor_pins (.clk(clk), .tick(tick),
        .take(take), .motor(motor), .step_forward(step_forward), .step_backward(step_backward), .set_levels(set_levels),
        .set_enable(set_enable), .set_times(set_times), .data(data), .step_pins(step_pins),
        .direction_pins(direction_pins), .enable_pins(enable_pins), .digital_pins(digital_pins));
    motors_analog #(.MOTORS(MOTORS), .MOTOR_BITS(MOTOR_BITS), .ANALOG(ANALOG)) analog (.clk(clk),
        .set_level(set_analog), .motor(motor), .channel(channel[0]), .level(data), .pins(analog_pins));
endmodule
