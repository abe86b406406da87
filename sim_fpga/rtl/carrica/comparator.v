// The counter, the multiplier and the comparator: n V_ref T_c >= 1 is the condition for a step.
//
// Source: Carrica, Funes, Gonzalez, Eqs. (7) and (11), Fig. 5. The multiplier is sequential, as in the paper: one bit
// of n in each clock, so 16 clocks for n of 16 bits. It adds from the lowest bit on and drops a bit of the sum each
// time. The bits that remain decide whether the product has reached 2^FRACTION, which is one step.
module comparator #(
    parameter FRACTION = 40,
    parameter COUNT_BITS = 16
) (
    input clk,
    input restart,            // n = 0
    input count,              // a T_c has passed: n + 1; the multiplication begins
    input [FRACTION:0] speed, // from the next clock on
    output reached            // COUNT_BITS clocks later
);
    reg [COUNT_BITS-1:0] n, bits;
    reg [FRACTION:0] sum;
    wire [COUNT_BITS-1:0] next = n + 1'b1;
    // verilator lint_off UNUSEDSIGNAL
    wire [FRACTION+1:0] more = {1'b0, sum} + (bits[0] ? {1'b0, speed} : 0); // the lowest bit is dropped
    // verilator lint_on UNUSEDSIGNAL
    assign reached = sum[FRACTION:FRACTION-COUNT_BITS] != 0;

    always @(posedge clk) begin
        if (restart) n <= 0;
        else if (count) n <= next;
        if (count) begin
            bits <= next;
            sum <= 0;
        end else begin
            bits <= bits >> 1;
            sum <= more[FRACTION+1:1];
        end
    end
endmodule
