// What the host wrote, for the device: its words and the output ring. The device reads a word in each clock, the one
// after its address.
module axis_host_memory #(
    parameter ENTRY_BITS = 5    // of the output ring
) (
    input clk,
    input write,
    input [19:3] write_address, // of a word in the map
    input [63:0] write_data,
    // Who reads, the first of these: a word, an entry for the outputs, or else one for axis_output_ring.v.
    input reads_word,
    input [6:0] word_address,   // {is in a table, word}
    input reads_entry,
    input [ENTRY_BITS+1:0] entry_address, // {entry, word}
    input [ENTRY_BITS+1:0] scan_address,
    output reg [63:0] word
);
    // verilator lint_off UNUSED
    `include "registers.vh"
    // verilator lint_on UNUSED
    localparam BITS = ENTRY_BITS + 2 > 7 ? ENTRY_BITS + 2 : 7;
    wire is_entry = write_address[19:16] == LOCKSTEP_OUTPUT_RING[19:16];
    wire is_word = write_address[19:14] == 0 && write_address[13] != write_address[12] && write_address[11:9] == 0;
    function [BITS-1:0] of_word(input [6:0] number);
        of_word = {{(BITS - 7){1'b0}}, number};
    endfunction
    function [BITS-1:0] of_entry(input [ENTRY_BITS+1:0] address);
        of_entry = {{(BITS - ENTRY_BITS - 2){1'b0}}, address};
    endfunction
    (* no_rw_check *) reg [63:0] words[0:(2 << BITS)-1];
    integer i;
    initial for (i = 0; i < 128; i = i + 1) words[i] = 0;
    always @(posedge clk) begin
        if (write && (is_entry || is_word)) words[{is_entry, is_entry ? of_entry(write_address[ENTRY_BITS+4:3]) :
            of_word({write_address[13], write_address[8:3]})}] <= write_data;
        word <= words[{!reads_word, reads_word ? of_word(word_address) :
            of_entry(reads_entry ? entry_address : scan_address)}];
    end
endmodule
