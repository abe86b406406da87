// The iCEBreaker drives five motors: a UP5K, which has the memory, and a crystal of 12 MHz. The host has the SPI
// (motors_spi.v).
module icebreaker (
    input crystal,
    input select_n,
    input sck,
    input mosi,
    output miso,
    input [4:0] switches_n,     // a switch connects its pin with ground when it closes
    output [4:0] step,
    output [4:0] direction,
    output [4:0] enable
);
    wire fast, is_locked, begun;
    // 12 MHz * (DIVF + 1) / 2^DIVQ = 42 MHz. The range of its filter is that of a PLL with 12 MHz at its input.
    SB_PLL40_PAD #(.FEEDBACK_PATH("SIMPLE"), .DIVR(4'd0), .DIVF(7'd55), .DIVQ(3'd4), .FILTER_RANGE(3'd1)) pll (
        .PACKAGEPIN(crystal), .RESETB(1'b1), .BYPASS(1'b0), .LOCK(is_locked), .PLLOUTCORE(fast));
    motors_start start (.fast(fast), .is_stable(is_locked), .begun(begun));
    reg runs;
    wire clk = fast && runs;
    initial runs = 0;
    always @(negedge fast) runs <= begun; // so that clk begins with a whole half of a period
    // verilator lint_off PINCONNECTEMPTY
    motors_spi_chip #(.MOTORS(5), .MOTOR_BITS(3)) motors (.clk(clk), .select_n(select_n), .sck(sck), .mosi(mosi),
        .miso(miso), .memory_writes(), .memory_address(), .memory_data(), .memory_word(16'd0), .inputs(~switches_n),
        .step(step), .direction(direction), .enable(enable), .digital(), .analog());
    // verilator lint_on PINCONNECTEMPTY
endmodule
