// Olimex's iCE40HX8K-EVB drives eight motors: an HX8K, an oscillator of 100 MHz, an SRAM of 256 Ki words of 16 bits and
// 10 ns. The host has the SPI (motors_spi.v).
module olimex_hx8k (
    input oscillator,
    input select_n,
    input sck,
    input mosi,
    output miso,
    output sram_cs_n,
    output sram_we_n,
    output sram_oe_n,
    output [17:0] sram_address,
    inout [15:0] sram_data,
    // A switch connects its pin with ground when it closes: {home, limit above, limit below} of each motor.
    input [23:0] switches_n,
    output [7:0] step,
    output [7:0] direction,
    output [7:0] enable,
    output [7:0] digital,
    output [7:0] analog
);
    wire drives;
    wire [15:0] write_data;
    assign sram_cs_n = 0;
    assign sram_address[17:16] = 0;
    assign sram_data = drives ? write_data : 16'bz;
    motors_spi_sram motors (.oscillator(oscillator), .select_n(select_n), .sck(sck), .mosi(mosi), .miso(miso),
        .sram_we_n(sram_we_n), .sram_oe_n(sram_oe_n), .sram_address(sram_address[15:0]), .sram_drives(drives),
        .sram_write_data(write_data), .sram_read_data(sram_data), .inputs(~switches_n), .step(step),
        .direction(direction), .enable(enable), .digital(digital), .analog(analog));
endmodule
