// A line that the host downloads: both displacements in pulses, in six bytes.
//
// Source: Lai, Chien, Tsao, Section 2 and 3.3.1, step 1: the displacements of the two axes are loaded ahead from the
// host. The paper does not give the bytes. Here they are 0x4C, x high, x low, y high, y low in two's complement, and a
// last byte that makes the sum of all six 0. A line with another sum is dropped, and the next 0x4C begins the next
// line.
module line_download (
    input clk,
    input reset,
    input byte_valid,
    input [7:0] byte_in,
    output reg valid,         // the line is complete; it stays until it is taken, and a later one replaces it
    input taken,
    output reg [15:0] x,
    output reg [15:0] y
);
    reg [2:0] count;          // of bytes so far
    reg [7:0] sum;
    reg [31:0] bytes;
    wire [7:0] next_sum = sum + byte_in;
    always @(posedge clk) begin
        if (reset) begin
            count <= 0;
            valid <= 0;
        end else begin
            if (taken) valid <= 0;
            if (byte_valid) begin
                sum <= next_sum;
                bytes <= {bytes[23:0], byte_in};
                count <= count + 1'b1;
                if (count == 0) begin
                    sum <= 8'h4c;
                    if (byte_in != 8'h4c) count <= 0;
                end else if (count == 5) begin
                    count <= 0;
                    if (next_sum == 0) begin
                        valid <= 1;
                        {x, y} <= bytes;
                    end
                end
            end
        end
    end
endmodule
