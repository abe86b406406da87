// All hardware of several motors, and the SPI of their host.
module motors_spi_chip #(
    parameter MOTORS = 8,
    parameter MOTOR_BITS = 3,
    parameter HAS_MEMORY = 1,   // 0: the memory is outside
    `include "rtl/motors/motors_sizes.vh"
) (
    input clk,
    // The host, as in motors_spi.v.
    input select_n,
    input sck,
    input mosi,
    output miso,
    // The memory, if it is outside, as in motors_device.v.
    output memory_writes,
    output [MOTOR_BITS+12:0] memory_address,
    output [15:0] memory_data,
    input [15:0] memory_word,
    // The motors, as in motors_chip.v.
    input [INPUTS*MOTORS-1:0] inputs,
    output [MOTORS-1:0] step,
    output [MOTORS-1:0] direction,
    output [MOTORS-1:0] enable,
    output [DIGITAL*MOTORS-1:0] digital,
    output [ANALOG*MOTORS-1:0] analog
);
    wire write, read, written, was_read, show, shows;
    wire [MOTOR_BITS-1:0] host_motor;
    wire [19:1] host_address;
    wire [63:0] write_data;
    wire [15:0] read_data;
    motors_spi #(.MOTORS(MOTORS), .MOTOR_BITS(MOTOR_BITS)) spi (.clk(clk), .select_n(select_n), .sck(sck), .mosi(mosi),
        .miso(miso), .write(write), .read(read), .host_motor(host_motor), .host_address(host_address),
        .write_data(write_data), .written(written), .was_read(was_read), .read_data(read_data), .show(show),
        .shows(shows));
    motors_chip #(.MOTORS(MOTORS), .MOTOR_BITS(MOTOR_BITS), .HAS_MEMORY(HAS_MEMORY), .TICK_CLOCKS(TICK_CLOCKS),
        .INPUTS(INPUTS), .DIGITAL(DIGITAL), .ANALOG(ANALOG)) chip (.clk(clk), .write(write), .read(read),
        .host_motor(host_motor), .host_address(host_address), .write_data(write_data), .written(written),
        .was_read(was_read), .read_data(read_data), .show(show), .shows(shows), .memory_writes(memory_writes),
        .memory_address(memory_address), .memory_data(memory_data), .memory_word(memory_word), .input_pins(inputs),
        .step_pins(step), .direction_pins(direction), .enable_pins(enable), .digital_pins(digital),
        .analog_pins(analog));
endmodule
