// What the host reads of the device: the words of the map, the capture ring (sim_fpga/capture_ring.hpp) and the event
// ring (sim_fpga/event_ring.hpp). axis_adder.v puts words there.
module axis_shown #(
    parameter CAPTURE_BITS = 8, // 2 to the power of it is the number of entries
    parameter EVENT_BITS = 4
) (
    input clk,
    input [63:0] word,          // that is put there
    // A step, for one clock, and later its word, unless it is lost.
    input step,
    input [CAPTURE_BITS:0] capture_tail, // low bits of CAPTURE_TAIL
    output capture_full,
    output reg step_is_lost,
    input puts_step,
    // An event, for one clock, and later its words, unless it is lost.
    input note,
    input [EVENT_BITS:0] event_tail, // low bits of EVENT_TAIL
    output reg note_is_lost,
    input puts_note,
    input [1:0] note_field,
    // A word of the map, from 0x0100 on.
    input puts_word,
    input [4:0] number,
    // The host reads, a clock after the address.
    input reads_event,
    input [EVENT_BITS+1:0] read_event,
    input [4:0] read_word_number,
    output reg [63:0] read_word, // of the map, or of the event ring
    input [CAPTURE_BITS-1:0] read_entry,
    output reg [63:0] read_step
);
    localparam BITS = EVENT_BITS + 2 > 5 ? EVENT_BITS + 2 : 5;
    (* no_rw_check *) reg [63:0] words[0:(2 << BITS)-1]; // the map's words, then the event ring
    (* no_rw_check *) reg [63:0] steps[0:(1 << CAPTURE_BITS)-1];
    reg [CAPTURE_BITS:0] steps_head; // low bits of CAPTURE_HEAD and of EVENT_HEAD
    reg [EVENT_BITS:0] notes_head;
    reg [EVENT_BITS-1:0] entry;
    wire [CAPTURE_BITS:0] steps_used = steps_head - capture_tail;
    wire [EVENT_BITS:0] notes_used = notes_head - event_tail;
    wire notes_full = notes_used[EVENT_BITS];
    assign capture_full = steps_used[CAPTURE_BITS];
    function [BITS:0] of_event(input [EVENT_BITS+1:0] address);
        of_event = {1'b1, {(BITS - EVENT_BITS - 2){1'b0}}, address};
    endfunction
    function [BITS:0] of_map(input [4:0] index);
        of_map = {{(BITS - 4){1'b0}}, index};
    endfunction

    integer i;
    initial begin
        {step_is_lost, note_is_lost, steps_head, notes_head, entry} = 0;
        for (i = 0; i < 32; i = i + 1) words[i] = 0;
    end
    always @(posedge clk) begin
        if (puts_word || puts_note) words[puts_note ? of_event({entry, note_field}) : of_map(number)] <= word;
        read_word <= words[reads_event ? of_event(read_event) : of_map(read_word_number)];
    end
    always @(posedge clk) begin
        if (puts_step) steps[steps_head[CAPTURE_BITS-1:0]] <= word;
        read_step <= steps[read_entry];
    end
    always @(posedge clk) begin
        if (step) step_is_lost <= capture_full;
        if (puts_step) steps_head <= steps_head + 1'b1;
        if (note) begin
            note_is_lost <= notes_full;
            entry <= notes_head[EVENT_BITS-1:0];
            if (!notes_full) notes_head <= notes_head + 1'b1;
        end
    end
endmodule
