// The capture ring: the tick of every step, and the sums by which a host finds a step that it has not read.
module axis_capture #(
    parameter ENTRY_BITS = 8
) (
    input clk,
    input step,                 // for one clock of at least two
    input forward,
    input [62:0] now,
    input [63:0] tail,          // CAPTURE_TAIL
    input [ENTRY_BITS-1:0] read_entry,
    output reg [63:0] read_word, // one clock after the entry
    output full,
    output reg [63:0] head,
    output reg [63:0] lost,
    output reg [63:0] sum,
    output reg [63:0] sums
);
    localparam [63:0] ENTRIES = 64'd1 << ENTRY_BITS;
    (* no_rw_check *) reg [63:0] entries[0:(1 << ENTRY_BITS)-1];
    wire [63:0] word = {now, forward};
    wire [63:0] used = head - tail;
    reg is_summed;              // the clock after a step
    assign full = used >= ENTRIES;

    initial {head, lost, sum, sums, is_summed} = 0;
    always @(posedge clk) begin
        if (step && !full) entries[head[ENTRY_BITS-1:0]] <= word;
        read_word <= entries[read_entry];
    end
    always @(posedge clk) begin
        is_summed <= step;
        if (is_summed) sums <= sums + sum;
        if (step) begin
            sum <= sum + word;
            if (full) lost <= lost + 1'b1;
            else head <= head + 1'b1;
        end
    end
endmodule
