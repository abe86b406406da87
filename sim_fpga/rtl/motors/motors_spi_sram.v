// All hardware of several motors, for a board with an SRAM of 10 ns and an oscillator of 100 MHz. The host has the SPI.
module motors_spi_sram #(
    parameter MOTORS = 8,
    parameter MOTOR_BITS = 3,
    `include "rtl/motors/motors_sizes.vh"
) (
    input oscillator,
    // The host, as in motors_spi.v.
    input select_n,
    input sck,
    input mosi,
    output miso,
    // The SRAM, as in motors_sram.v.
    output sram_we_n,
    output sram_oe_n,
    output [MOTOR_BITS+12:0] sram_address,
    output sram_drives,
    output [15:0] sram_write_data,
    input [15:0] sram_read_data,
    // The motors, as in motors_chip.v.
    input [INPUTS*MOTORS-1:0] inputs,
    output [MOTORS-1:0] step,
    output [MOTORS-1:0] direction,
    output [MOTORS-1:0] enable,
    output [DIGITAL*MOTORS-1:0] digital,
    output [ANALOG*MOTORS-1:0] analog
);
    wire clk, writes, write, read, written, was_read, show, shows;
    wire [MOTOR_BITS-1:0] host_motor;
    wire [19:1] host_address;
    wire [63:0] write_data;
    wire [MOTOR_BITS+12:0] address;
    wire [15:0] data, word, read_data;
    motors_spi #(.MOTORS(MOTORS), .MOTOR_BITS(MOTOR_BITS)) spi (.clk(clk), .select_n(select_n), .sck(sck), .mosi(mosi),
        .miso(miso), .write(write), .read(read), .host_motor(host_motor), .host_address(host_address),
        .write_data(write_data), .written(written), .was_read(was_read), .read_data(read_data), .show(show),
        .shows(shows));
    motors_sram #(.ADDRESS_BITS(MOTOR_BITS + 13)) sram (.fast(oscillator), .clk(clk), .write(writes),
        .address(address), .data(data), .word(word), .we_n(sram_we_n), .oe_n(sram_oe_n), .pin_address(sram_address),
        .drives(sram_drives), .pin_data(sram_write_data), .pin_word(sram_read_data));
    motors_chip #(.MOTORS(MOTORS), .MOTOR_BITS(MOTOR_BITS), .HAS_MEMORY(0), .TICK_CLOCKS(TICK_CLOCKS), .INPUTS(INPUTS),
        .DIGITAL(DIGITAL), .ANALOG(ANALOG)) chip (.clk(clk), .write(write), .read(read), .host_motor(host_motor),
        .host_address(host_address), .write_data(write_data), .written(written), .was_read(was_read),
        .read_data(read_data), .show(show), .shows(shows), .memory_writes(writes), .memory_address(address),
        .memory_data(data), .memory_word(word), .input_pins(inputs), .step_pins(step), .direction_pins(direction),
        .enable_pins(enable), .digital_pins(digital), .analog_pins(analog));
endmodule
