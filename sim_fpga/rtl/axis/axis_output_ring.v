// Finds the outputs of the next frame in the output ring and checks them before they are needed, so that a frame begins
// without a search. It is sim_fpga/output_ring.hpp. Entries of the present frame stay in the ring until it ends.
module axis_output_ring #(
    parameter ENTRY_BITS = 5,
    parameter DIGITAL = 8,
    parameter ANALOG = 2,
    parameter [7:0] MOST_IN_BODY = 192, // changes of a frame
    parameter [7:0] MOST_IN_TAIL = 64
) (
    input clk,
    input [ENTRY_BITS:0] head,  // low bits of OUTPUT_HEAD
    // The sequencer.
    input [23:0] run,           // low bits of the run
    input [31:0] frame,         // the present frame
    input restart,              // for one clock: a run begins or ends
    input rests,                // no run is in progress
    input in_motion,
    input drop_own,             // takes entries of the run off the ring
    input take,                 // for one clock: the next frame begins
    output settled,             // nothing of what follows changes until the host or the sequencer acts
    output reg is_well,         // the outputs of the next frame can be made
    output [ENTRY_BITS:0] tail, // low bits of OUTPUT_TAIL
    output reg [ENTRY_BITS:0] first, // entries of the present frame are from here on
    output reg [ENTRY_BITS:0] behind, // and before here
    // The ring's memory. Others have it while this is paused.
    input pause,
    output [ENTRY_BITS+1:0] address, // {entry, word}
    input [63:0] word
);
    localparam LOOK = 0, TAG = 1, AT = 2, VALUE = 3, STOP = 4;
    reg [2:0] state;
    reg asked;                  // the memory shows the word
    reg [ENTRY_BITS:0] at;      // the entry
    reg [ENTRY_BITS:0] its_first; // of the next frame
    reg is_found;
    reg is_tail;                // of the frame
    reg [1:0] kind;
    reg [2:0] channel;
    reg [42:0] last_in_body, last_in_tail;
    reg [7:0] in_body, in_tail; // changes found, until they are too many
    wire [1:0] number = state == AT ? 2'd1 : state == VALUE ? 2'd2 : 2'd0;
    assign address = {at[ENTRY_BITS-1:0], number};

    wire [ENTRY_BITS:0] loaded = head - at;
    wire is_empty = loaded == 0 || (loaded[ENTRY_BITS] && loaded[ENTRY_BITS-1:0] != 0);
    wire of_run = word[31:8] == run;
    wire [31:0] ahead = word[63:32] - frame - 1'b1;
    wire is_of_frame = of_run && ahead == 0;
    wire is_later = of_run && !ahead[31] && ahead != 0;
    wire [42:0] last = is_tail ? last_in_tail : last_in_body;
    wire is_in_order = word[63:43] == 0 && word[42:0] != 0 && word[42:0] <= 43'h40000000000 && word[42:0] >= last;
    wire has_room = is_tail ? in_tail != MOST_IN_TAIL : in_body != MOST_IN_BODY;
    wire is_possible = kind == 0 ? word[31:16] >> DIGITAL == 0 : kind == 1 && {29'd0, channel} < ANALOG;
    assign settled = !restart && !take && (is_empty || state == STOP);
    assign tail = in_motion ? first : behind;

    initial begin
        {state, asked, at, its_first, is_found, is_tail, kind, channel, last_in_body, last_in_tail, first, behind} = 0;
        {in_body, in_tail} = 0;
        is_well = 1;
    end
    always @(posedge clk) begin
        asked <= !asked && !pause && state != STOP;
        case (state)
            LOOK: begin
                asked <= 0;
                if (!is_empty) state <= TAG;
            end
            TAG: if (asked) begin
                {channel, kind, is_tail} <= word[5:0];
                if (rests) begin
                    if (!of_run) state <= STOP;
                    else if (drop_own) begin
                        at <= at + 1'b1;
                        behind <= at + 1'b1;
                        state <= LOOK;
                    end
                end else if (is_later) state <= STOP;
                else if (is_of_frame) begin
                    is_found <= 1;
                    if (!is_found) its_first <= at;
                    state <= AT;
                end else begin
                    at <= at + 1'b1;
                    state <= LOOK;
                end
            end
            AT: if (asked) begin
                if (!is_in_order || !has_room) is_well <= 0;
                if (is_tail) {in_tail, last_in_tail} <= {in_tail + 1'b1, word[42:0]};
                else {in_body, last_in_body} <= {in_body + 1'b1, word[42:0]};
                state <= VALUE;
            end
            VALUE: if (asked) begin
                if (!is_possible) is_well <= 0;
                at <= at + 1'b1;
                state <= LOOK;
            end
            default: ;
        endcase
        if (take) begin
            first <= is_found ? its_first : at;
            behind <= at;
        end
        if (take || restart) begin
            at <= take ? at : behind;
            state <= LOOK;
            asked <= 0;
            is_found <= 0;
            is_well <= 1;
            {last_in_body, last_in_tail, in_body, in_tail} <= 0;
        end
    end
endmodule
