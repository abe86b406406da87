// Three motors behind an SPI, with the chip's own memory: sim_fpga/rtl/motors as a board has it that needs no SRAM.
module spi_board #(
    parameter MOTORS = 3,
    parameter MOTOR_BITS = 2,
    `include "rtl/motors/motors_sizes.vh"
) (
    input clk,
    input select_n,
    input sck,
    input mosi,
    output miso,
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
    // verilator lint_off PINCONNECTEMPTY
    motors_chip #(.MOTORS(MOTORS), .MOTOR_BITS(MOTOR_BITS), .TICK_CLOCKS(TICK_CLOCKS), .INPUTS(INPUTS),
        .DIGITAL(DIGITAL), .ANALOG(ANALOG)) chip (.clk(clk), .write(write), .read(read), .host_motor(host_motor),
        .host_address(host_address), .write_data(write_data), .written(written), .was_read(was_read),
        .read_data(read_data), .show(show), .shows(shows), .memory_writes(), .memory_address(), .memory_data(),
        .memory_word(16'd0), .input_pins(inputs), .step_pins(step), .direction_pins(direction), .enable_pins(enable),
        .digital_pins(digital), .analog_pins(analog));
    // verilator lint_on PINCONNECTEMPTY
endmodule
