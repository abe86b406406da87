// The event ring: every change of an input, with the place of the axis. It is sim_fpga/event_ring.hpp.
module axis_events #(
    parameter ENTRY_BITS = 4
) (
    input clk,
    input put,                  // for one clock, while it is not busy: this input changes
    input [4:0] channel,
    input closed,
    input [63:0] now,           // these stay as they are while it is busy
    input [63:0] count,
    input [63:0] phase,
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
    reg is_closed;
    reg [63:0] word;
    always @* case (at)
        0: word = now;
        1: word = {47'd0, is_closed, 3'd0, its_channel, 8'd0}; // KIND 0: INPUT
        2: word = count;
        3: word = phase;
    endcase
    axis_ring_memory #(.ENTRY_BITS(ENTRY_BITS)) entries (.clk(clk), .write(busy),
        .write_address({head[ENTRY_BITS-1:0], at}), .write_data(word), .read_address(read_address), .word(read_word));

    initial {busy, head, lost, at, its_channel, is_closed} = 0;
    always @(posedge clk) begin
        if (put && !is_full) begin
            busy <= 1;
            its_channel <= channel;
            is_closed <= closed;
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
