// Finds the next frame in the segment ring and checks it before it is needed: its header, and each of its pieces. So
// the sequencer decides about a frame in one clock, however long the frame is.
//
// It is sim_fpga/segment_ring.hpp, with two differences. A frame that was found is not read again, so the host must not
// change it (it may not, by the map). The velocity at the end of a piece is not checked here, because that takes a
// multiplication: axis_engine.v notices the tick in which the velocity leaves 64 bits.
module axis_frame_scanner #(
    parameter ENTRY_BITS = 8,
    parameter MOST_PIECES = 274 // of a frame
) (
    input clk,
    input [ENTRY_BITS:0] head,  // low bits of SEGMENT_HEAD
    input [23:0] run,           // low bits of a run
    input drop_own,             // takes frames of the run off the ring
    input drop_others,          // takes frames of other runs off the ring
    input take,                 // for one clock: takes the present frame, which is good
    // The ring's memory. The sequencer has it while it is paused.
    input pause,
    output [ENTRY_BITS+1:0] address,
    // verilator lint_off UNUSED
    input [63:0] word,
    // verilator lint_on UNUSED
    output settled,             // nothing of what follows changes until the host or the sequencer acts
    output valid,               // there is a frame
    output good,                // it is whole and can be run
    output reg [ENTRY_BITS:0] taken, // low bits of the entries taken off the ring: where the frame begins
    output is_last,
    output is_of_run,
    output reg [31:0] number,
    output reg [15:0] body_pieces,
    output reg [15:0] tail_pieces
);
    localparam LOOK = 0, HEADER = 1, CHECK = 2, KNOWN = 3;
    reg [1:0] state;
    reg [15:0] at;              // the word of the header, or the piece
    reg asked;                  // the memory shows it
    reg is_header, is_last_frame, is_well;
    reg [23:0] tag_run;

    reg [ENTRY_BITS:0] loaded;  // entries in the ring, a clock later
    wire is_loaded = loaded != 0 && (!loaded[ENTRY_BITS] || loaded[ENTRY_BITS-1:0] == 0);
    wire [16:0] pieces = {1'b0, body_pieces} + {1'b0, tail_pieces};
    wire is_whole = pieces < {{(16 - ENTRY_BITS){1'b0}}, loaded};
    wire is_found = state == CHECK || state == KNOWN;
    wire is_possible = body_pieces != 0 && pieces <= MOST_PIECES;
    wire drops = is_found && is_loaded && (is_of_run ? drop_own : drop_others);
    wire waits = state == CHECK && is_possible && !is_whole; // for the rest of the frame
    wire is_piece = !word[0] && word[39:8] != 0 && word[63:40] == 0;

    wire [ENTRY_BITS:0] behind = taken + pieces[ENTRY_BITS:0] + 1'b1;
    wire [ENTRY_BITS-1:0] piece = taken[ENTRY_BITS-1:0] + at[ENTRY_BITS-1:0];
    assign address = state == CHECK ? {piece, 2'd0} : {taken[ENTRY_BITS-1:0], at[1:0]};
    assign is_of_run = is_header && tag_run == run;
    assign is_last = is_last_frame;
    assign valid = is_found && is_loaded;
    assign good = state == KNOWN && is_well;
    wire is_empty = !is_loaded && (is_found || (state == LOOK && at != 0));
    assign settled = !drops && (is_empty || state == KNOWN || waits);

    initial begin
        {state, at, asked, loaded, is_header, is_last_frame, is_well, tag_run, taken} = 0;
        {number, body_pieces, tail_pieces} = 0;
    end
    always @(posedge clk) begin
        loaded <= head - taken;
        asked <= !asked && !pause;
        case (state)
            LOOK: begin
                at <= 1;
                asked <= 0;
                if (at != 0 && is_loaded) begin
                    at <= 0;
                    state <= HEADER;
                end
            end
            HEADER: if (asked) begin
                at <= 2;
                if (at == 0) {number, tag_run, is_last_frame, is_header} <= {word[63:8], word[1:0]};
                else begin
                    {tail_pieces, body_pieces} <= word[63:32];
                    at <= 1;
                    state <= CHECK;
                    is_well <= 1;
                end
            end
            CHECK: if (!is_possible || !is_well || (is_whole && {1'b0, at} > pieces)) begin
                state <= KNOWN;
                is_well <= is_possible && is_well;
            end else if (asked && is_whole) begin
                at <= at + 1'b1;
                is_well <= is_piece;
            end
            default: ;
        endcase
        if (take) begin
            taken <= behind;
            at <= 0;
            state <= LOOK;
        end else if (drops) begin
            taken <= !is_header ? taken + 1'b1 : is_whole ? behind : head;
            at <= 0;
            state <= LOOK;
        end
    end
endmodule
