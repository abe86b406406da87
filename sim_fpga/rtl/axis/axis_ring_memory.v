// The memory of a ring whose entries have 32 bytes: the host writes words of 64 bits, the device reads one in each
// clock, the one after the address.
module axis_ring_memory #(
    parameter ENTRY_BITS = 8    // 2 to the power of it is the number of entries
) (
    input clk,
    input write,
    input [ENTRY_BITS+1:0] write_address, // {entry, word}
    input [63:0] write_data,
    input [ENTRY_BITS+1:0] read_address,
    output reg [63:0] word
);
    (* no_rw_check *) reg [63:0] words[0:(4 << ENTRY_BITS)-1];
    always @(posedge clk) begin
        if (write) words[write_address] <= write_data;
        word <= words[read_address];
    end
endmodule
