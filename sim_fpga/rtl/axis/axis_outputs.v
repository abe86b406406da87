// The outputs: levels, and analog values that change by their slope in each tick. They change with the frames that run,
// at once by a direct request, and to a safe state. It is sim_fpga/output_unit.hpp, without pulses at places.
//
// The sequencer asks for one thing at a time, for one clock, and waits while it is done.
module axis_outputs #(
    parameter ENTRY_BITS = 5,
    parameter DIGITAL = 8,
    parameter ANALOG = 2        // at most 8
) (
    input clk,
    // What the sequencer asks for.
    input direct,               // what the host asks for directly
    input due,                  // the changes of the present frame that are due
    input begin_body,           // a clock later `first` is that of the frame
    input is_well,              // then: its outputs can be made
    input begin_tail,
    input end_run,              // values stay as they are
    input is_cut,               // and then: as OUTPUTS_AT_CUT says
    input silence,              // the same, as OUTPUTS_AT_SILENCE says
    input tick,
    output busy,                // from the clock after on
    input is_host_silent,
    // The setup.
    input [39:0] at_cut,
    input [39:0] at_silence,
    // The host's words.
    input asks_direct,          // there is a new DIRECT_REQUEST
    // The host's words and the output ring, in axis_host_memory.v.
    output reads_word,
    output [6:0] word_address,
    output reads_entry,
    output [ENTRY_BITS+1:0] entry_address,
    input [63:0] word,          // one clock after the address
    // The ring's entries of the present frame.
    input [23:0] run,
    input [31:0] frame,
    input [ENTRY_BITS:0] first,
    input [ENTRY_BITS:0] behind,
    // A change, for one clock. Until its event is noted, `word` is the value of an analog output that is given one, and
    // its slope in the clock after `asks_slope`.
    output put,
    output reg is_analog,
    output reg [4:0] channel,
    output gives_value,         // else the analog output becomes 0, or keeps its value
    output keeps_value,
    output gives_slope,         // else its slope ends
    input asks_slope,
    input [7:0] has_slope,
    input [7:0] is_zero,        // it was given 0, or keeps 0
    input events_busy,
    // What the outputs show.
    output reg [15:0] levels
);
    localparam REST = 0, DIRECT = 1, CHANNEL = 2, NEXT = 3, TAG = 4, AT = 5, VALUE = 6, DIGITAL_CHANGE = 7,
        ANALOG_CHANGE = 8, NOTE = 9, NOTED = 10, END = 11, SAFE_CHANNEL = 12;
    localparam [6:0] DIRECT_OUTPUTS = 7'd12, FIRST_DIRECT_VALUE = 7'd65; // in axis_host_memory.v
    reg [3:0] state, back;      // `back`: after a change
    reg asked;                  // the memory shows the word
    reg is_silence, is_safe_asked;
    wire [39:0] safe = is_silence ? at_silence : at_cut;
    reg [7:0] mask;             // the analog outputs that change
    // The list of changes.
    reg is_active, in_tail, is_known, is_usable, begins; // `is_known`: the entry is one of the present list
    reg [ENTRY_BITS:0] at;
    reg [42:0] since;           // ticks after the start of the body or the tail
    reg [1:0] kind;
    reg [2:0] due_channel;
    reg [15:0] new_levels, new_mask;

    wire [15:0] changed_levels = (levels & ~new_mask) | (new_levels & new_mask);
    wire [7:0] safe_off = safe[39:32];
    wire is_last = {27'd0, channel} == ANALOG;
    assign busy = state != REST;
    // While an analog change is noted, its words are read.
    wire is_given = state == NOTED && is_analog;
    assign gives_value = back == CHANNEL || back == NEXT;
    assign keeps_value = back == END;
    assign gives_slope = back == NEXT;
    assign reads_word = (state == DIRECT && !asked) || (is_given && back == CHANNEL);
    assign word_address = state == DIRECT ? DIRECT_OUTPUTS : FIRST_DIRECT_VALUE + {1'b0, channel, 1'b0};
    assign reads_entry = ((state == TAG || state == AT || state == VALUE) && !asked) || (is_given && back == NEXT);
    assign entry_address = {at[ENTRY_BITS-1:0], state == TAG ? 2'd0 : state == AT ? 2'd1 : asks_slope ? 2'd3 : 2'd2};
    assign put = state == NOTE && !events_busy;
    wire is_this = word[31:8] == run && word[63:32] == frame && word[0] == in_tail;

    initial begin
        {state, back, asked, is_silence, is_safe_asked, mask, is_active, in_tail, is_known, at, since} = 0;
        {is_usable, begins, kind, due_channel, new_levels, new_mask, levels, is_analog, channel} = 0;
    end
    always @(posedge clk) begin
        asked <= busy && !asked && state != NEXT;
        case (state)
            REST: begin
                asked <= 0;
                channel <= 0;
                if (direct && asks_direct && !is_host_silent) state <= DIRECT;
                if (due && is_active) state <= NEXT;
                if (end_run || silence) begin
                    is_active <= 0;
                    is_silence <= silence;
                    is_safe_asked <= silence || is_cut;
                    state <= END;
                end
            end
            // What the host asks for directly: levels, then one channel after the other.
            DIRECT: if (asked) begin
                new_levels <= word[15:0];
                new_mask <= word[31:16] & ((16'd1 << DIGITAL) - 16'd1);
                mask <= word[39:32];
                back <= CHANNEL;
                state <= DIGITAL_CHANGE;
            end
            CHANNEL: begin
                asked <= 0;
                if (is_last) state <= REST;
                else if (mask[channel[2:0]]) state <= ANALOG_CHANGE;
                else channel <= channel + 1'b1;
            end
            // The changes of the frame.
            NEXT: state <= is_known ? AT : at == behind ? REST : TAG;
            TAG: if (asked) begin
                {due_channel, kind} <= word[5:1];
                is_known <= is_this;
                if (!is_this) at <= at + 1'b1;
                state <= NEXT;
            end
            AT: if (asked) state <= word[42:0] > since ? REST : VALUE;
            VALUE: if (asked) begin
                {new_mask, new_levels} <= word[31:0];
                channel <= {2'd0, due_channel};
                is_known <= 0;
                back <= NEXT;
                state <= kind == 0 ? DIGITAL_CHANGE : ANALOG_CHANGE;
            end
            // A change, and its event.
            DIGITAL_CHANGE: begin
                levels <= changed_levels;
                is_analog <= 0;
                state <= changed_levels != levels ? NOTE : back;
                asked <= 0;
                if (back == NEXT && changed_levels == levels) at <= at + 1'b1;
            end
            ANALOG_CHANGE: begin
                is_analog <= 1;
                state <= NOTE;
            end
            NOTE: if (!events_busy) state <= NOTED;
            NOTED: begin
                asked <= 0;
                if (!events_busy) begin
                    if (back == NEXT) at <= at + 1'b1;
                    else if (is_analog) channel <= channel + 1'b1;
                    state <= back;
                end
            end
            // The end of a run: slopes end, then outputs become safe.
            END: begin
                if (is_last) begin
                    channel <= 0;
                    {new_mask, new_levels} <= safe[31:0];
                    back <= SAFE_CHANNEL;
                    state <= is_safe_asked ? DIGITAL_CHANGE : REST;
                end else if (has_slope[channel[2:0]]) begin
                    back <= END;
                    state <= ANALOG_CHANGE;
                end else channel <= channel + 1'b1;
            end
            SAFE_CHANNEL: begin
                if (is_last) state <= REST;
                else if (safe_off[channel[2:0]] && !is_zero[channel[2:0]]) begin
                    back <= SAFE_CHANNEL;
                    state <= ANALOG_CHANGE;
                end else channel <= channel + 1'b1;
            end
            default: state <= REST;
        endcase
        begins <= begin_body || begin_tail;
        if (begin_body) is_usable <= is_well;
        if (begin_body || begin_tail) begin
            in_tail <= begin_tail;
            since <= 0;
        end else if (tick) since <= since + 1'b1;
        if (begins) begin
            is_active <= is_usable && !is_host_silent;
            is_known <= 0;
            at <= first;
        end
    end
endmodule
