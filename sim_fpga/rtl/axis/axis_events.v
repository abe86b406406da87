// The event ring: every change of an input or an output. It is sim_fpga/event_ring.hpp.
module axis_events #(
    parameter ENTRY_BITS = 4
) (
    input clk,
    input put,                  // for one clock, while it is not busy
    input [1:0] kind,           // as in WHAT
    input [4:0] channel,
    input [15:0] levels,
    input [63:0] now,           // these stay as they are while it is busy
    input [63:0] value,
    input [63:0] detail,
    output reg busy,
    input [63:0] tail,          // EVENT_TAIL
    input [ENTRY_BITS+1:0] read_address,
    output [63:0] read_word,    // one clock after the address
    output reg [63:0] head,
    output reg [63:0] lost
);
    localparam [63:0] ENTRIES = 64'd1 << ENTRY_BITS;
    wire [63:0] used = head - tail;
    wire is_full = used >= ENTRIES;
    reg [1:0] at;               // the word that is written
    reg [4:0] its_channel;
    reg [1:0] its_kind;
    reg [15:0] its_levels;
    reg [63:0] word;
    always @* case (at)
        0: word = now;
        1: word = {32'd0, its_levels, 3'd0, its_channel, 6'd0, its_kind};
        2: word = value;
        3: word = detail;
    endcase
    axis_ring_memory #(.ENTRY_BITS(ENTRY_BITS)) entries (.clk(clk), .write(busy),
        .write_address({head[ENTRY_BITS-1:0], at}), .write_data(word), .read_address(read_address), .word(read_word));

    initial {busy, head, lost, at, its_channel, its_kind, its_levels} = 0;
    always @(posedge clk) begin
        if (put && !is_full) begin
            busy <= 1;
            its_channel <= channel;
            its_kind <= kind;
            its_levels <= levels;
        end else if (put) lost <= lost + 1'b1;
        if (busy) begin
            at <= at + 1'b1;
            if (at == 3) begin
                busy <= 0;
                head <= head + 1'b1;
            end
        end
    end
endmodule
