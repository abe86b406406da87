// The host's words of the register map. Those that the sequencer compares in each tick are in registers. All of them
// are in memory, where the host reads them again and axis_setup.v reads the setup.
module axis_host_words #(
    parameter CAPTURE_BITS = 8,
    parameter EVENT_BITS = 4,
    parameter SEGMENT_BITS = 8,
    parameter OUTPUT_BITS = 5
) (
    input clk,
    input write,
    input [19:3] write_address, // of a word in the map
    input [63:0] write_data,
    input [6:0] read_address,    // {is in a table, word}
    output reg [63:0] read_word, // one clock after the address
    input [6:0] setup_address,
    output reg [63:0] setup_word, // one clock after the address
    output reg [63:0] run_request,
    output reg [32:0] trigger,
    output reg [63:0] armed,
    output reg [63:0] veto,
    output reg [63:0] stop,
    // Of the rings' heads and tails the low bits, for there are no more entries than the ring has.
    output reg [SEGMENT_BITS:0] segment_head,
    output reg [CAPTURE_BITS:0] capture_tail,
    output reg [EVENT_BITS:0] event_tail,
    output reg [63:0] beat,
    output reg enable,
    output reg [OUTPUT_BITS:0] output_head,
    output reg [63:0] direct_request,
    output reg [63:0] setup_request
);
    // verilator lint_off UNUSED
    `include "registers.vh"
    // verilator lint_on UNUSED
    wire [19:0] byte_address = {write_address, 3'd0};
    // 0x1000 to 0x11F8 and 0x2000 to 0x21F8, which are the tables.
    wire is_host_word = write_address[19:14] == 0 && write_address[13] != write_address[12] && write_address[11:9] == 0;
    (* no_rw_check *) reg [63:0] words[0:127];
    integer i;
    initial begin
        for (i = 0; i < 128; i = i + 1) words[i] = 0;
        {run_request, trigger, armed, veto, stop, segment_head, capture_tail, event_tail, beat} = 0;
        {enable, setup_request, output_head, direct_request} = 0;
    end
    always @(posedge clk) begin
        if (write && is_host_word) words[{write_address[13], write_address[8:3]}] <= write_data;
        read_word <= words[read_address];
        setup_word <= words[setup_address];
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
        LOCKSTEP_BEAT: beat <= write_data;
        LOCKSTEP_ENABLE: enable <= write_data != 0;
        LOCKSTEP_OUTPUT_HEAD: output_head <= write_data[OUTPUT_BITS:0];
        LOCKSTEP_DIRECT_REQUEST: direct_request <= write_data;
        LOCKSTEP_SETUP_REQUEST: setup_request <= write_data;
        default: ;
    endcase
endmodule
