// A UART receiver: eight bits, no parity, one stop bit.
//
// Source: Lai, Chien, Tsao, Section 4: the host downloads by a UART at 19,200 baud. It samples each bit in its middle,
// so the two clocks may differ by 4 %. A byte without a stop bit is dropped.
module uart_receiver #(
    parameter CLOCKS_PER_BIT = 625, // 12 MHz / 19,200; at least 4
    parameter BITS = 10        // of a number of clocks
) (
    input clk,
    input reset,
    input line,               // 1 at rest
    output reg valid,         // for one clock
    output reg [7:0] byte_out
);
    reg [1:0] sampled;        // two registers against metastability
    reg [BITS-1:0] wait_clocks;
    reg [3:0] bits_left;      // 10: the start bit is next, 1: the stop bit; 0: at rest
    wire level = sampled[1];

    always @(posedge clk) begin
        sampled <= {sampled[0], line};
        valid <= 0;
        if (reset) begin
            sampled <= 2'b11;
            bits_left <= 0;
        end else if (bits_left == 0) begin
            wait_clocks <= CLOCKS_PER_BIT / 2 - 1;
            if (!level) bits_left <= 10;
        end else if (wait_clocks != 0) begin
            wait_clocks <= wait_clocks - 1'b1;
        end else begin
            wait_clocks <= CLOCKS_PER_BIT - 1;
            bits_left <= bits_left - 1'b1;
            if (bits_left == 10 && level) bits_left <= 0; // no start bit, but a short disturbance
            if (bits_left == 1) valid <= level;
            else byte_out <= {level, byte_out[7:1]};
        end
    end
endmodule
