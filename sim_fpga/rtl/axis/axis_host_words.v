// The host's words of the register map. Those that the sequencer compares in each tick are in registers. All of them
// are in memory, where the host reads them again. There are the constants of the map, too.
//
// A word is put into memory a clock after it was written, beside the word that was there, so a new number is noticed
// where it is written. The host does not read in the clock in which it writes, nor that word in the next one.
module axis_host_words #(
    parameter CAPTURE_BITS = 8,
    parameter EVENT_BITS = 4,
    parameter SEGMENT_BITS = 8,
    parameter OUTPUT_BITS = 5,
    parameter [2047:0] CONSTANTS = 2048'd0 // the words of the map from 0 to 0xF8
) (
    input clk,
    input write,
    input [19:3] write_address, // of a word in the map
    input [63:0] write_data,
    input [7:0] read_address,   // {is constant, is in a table, word}
    output reg [63:0] read_word, // one clock after the address
    output reg [63:0] run_request,
    output reg [32:0] trigger,
    output reg [63:0] armed,
    output reg [63:0] veto,
    output reg [63:0] stop,
    output reg enable,
    // Of the rings' heads and tails the low bits, for there are no more entries than the ring has.
    output reg [SEGMENT_BITS:0] segment_head,
    output reg [CAPTURE_BITS:0] capture_tail,
    output reg [EVENT_BITS:0] event_tail,
    output reg [OUTPUT_BITS:0] output_head,
    // There is a new number, until it is taken.
    output reg beats,
    input take_beat,
    output reg asks_direct,
    input take_direct,
    output reg asks_setup,
    input take_setup
);
    // verilator lint_off UNUSED
    `include "registers.vh"
    // verilator lint_on UNUSED
    wire [19:0] byte_address = {write_address, 3'd0};
    // 0x1000 to 0x11F8 and 0x2000 to 0x21F8, which are the tables.
    wire is_host_word = write_address[19:14] == 0 && write_address[13] != write_address[12] && write_address[11:9] == 0;
    wire [6:0] at = {write_address[13], write_address[8:3]};
    (* no_rw_check *) reg [63:0] words[0:255];
    reg written;
    reg [6:0] written_at;
    reg [63:0] data;
    wire is_new = written && data != read_word;
    integer i;
    initial begin
        for (i = 0; i < 256; i = i + 1) words[i] = 0;
        for (i = 0; i < 32; i = i + 1) words[128 + i] = CONSTANTS[64*i +: 64];
        {run_request, trigger, armed, veto, stop, segment_head, capture_tail, event_tail, output_head, enable} = 0;
        {written, written_at, data, beats, asks_direct, asks_setup} = 0;
    end
    always @(posedge clk) begin
        if (written) words[{1'b0, written_at}] <= data;
        read_word <= words[write ? {1'b0, at} : read_address];
    end
    always @(posedge clk) begin
        written <= write && is_host_word;
        written_at <= at;
        data <= write_data;
        beats <= (is_new && written_at == LOCKSTEP_BEAT[9:3]) || (beats && !take_beat);
        asks_direct <= (is_new && written_at == LOCKSTEP_DIRECT_REQUEST[9:3]) || (asks_direct && !take_direct);
        asks_setup <= (is_new && written_at == LOCKSTEP_SETUP_REQUEST[9:3]) || (asks_setup && !take_setup);
    end
    always @(posedge clk) if (write) case (byte_address)
        LOCKSTEP_RUN_REQUEST: run_request <= write_data;
        LOCKSTEP_TRIGGER: trigger <= write_data[32:0];
        LOCKSTEP_ARMED: armed <= write_data;
        LOCKSTEP_VETO: veto <= write_data;
        LOCKSTEP_STOP: stop <= write_data;
        LOCKSTEP_SEGMENT_HEAD: segment_head <= write_data[SEGMENT_BITS:0];
        LOCKSTEP_CAPTURE_TAIL: capture_tail <= write_data[CAPTURE_BITS:0];
        LOCKSTEP_EVENT_TAIL: event_tail <= write_data[EVENT_BITS:0];
        LOCKSTEP_ENABLE: enable <= write_data != 0;
        LOCKSTEP_OUTPUT_HEAD: output_head <= write_data[OUTPUT_BITS:0];
        default: ;
    endcase
endmodule
