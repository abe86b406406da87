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
    wire begun, writes;
    reg clk;
    wire [MOTOR_BITS+12:0] address;
    wire [15:0] data, word;
    initial clk = 0;
    always @(posedge oscillator) clk <= begun && !clk;
    motors_start start (.fast(oscillator), .is_stable(1'b1), .begun(begun));
    motors_sram #(.ADDRESS_BITS(MOTOR_BITS + 13)) sram (.fast(oscillator), .clk(clk), .write(writes),
        .address(address), .data(data), .word(word), .we_n(sram_we_n), .oe_n(sram_oe_n), .pin_address(sram_address),
        .drives(sram_drives), .pin_data(sram_write_data), .pin_word(sram_read_data));
    motors_spi_chip #(.MOTORS(MOTORS), .MOTOR_BITS(MOTOR_BITS), .HAS_MEMORY(0), .TICK_CLOCKS(TICK_CLOCKS),
        .INPUTS(INPUTS), .DIGITAL(DIGITAL), .ANALOG(ANALOG)) chip (.clk(clk), .select_n(select_n), .sck(sck),
        .mosi(mosi), .miso(miso), .memory_writes(writes), .memory_address(address), .memory_data(data),
        .memory_word(word), .inputs(inputs), .step(step), .direction(direction), .enable(enable), .digital(digital),
        .analog(analog));
endmodule
