// The device's words as the host reads them. They are written after each tick, all of one state, and SEQUENCE is odd
// meanwhile. While `hold` is high they stay as they are: a host behind a slow link then reads one consistent state,
// however long that takes.
module axis_mirror (
    input clk,
    input publish,              // for one clock
    input hold,
    output reg busy,
    input [4:0] read_word_number,
    output reg [63:0] read_word, // one clock after the number
    output reg is_published,    // since power-up
    input [63:0] now,
    input [16:0] status,
    input [63:0] count,
    input [63:0] phase,
    input [63:0] velocity,
    input [63:0] run,
    input [63:0] frame,
    input [63:0] trigger_count,
    input [63:0] segment_tail,
    input [63:0] capture_head,
    input [63:0] capture_lost,
    input [63:0] capture_sum,
    input [63:0] capture_sums,
    input [63:0] setup,
    input [31:0] inputs,
    input [63:0] event_head,
    input [63:0] event_lost,
    input [15:0] outputs,
    input [63:0] output_tail,
    input [127:0] analog
);
    localparam LAST = 23;       // the word at 0x01B8
    (* no_rw_check *) reg [63:0] words[0:31];
    reg [4:0] at;               // the word that is written
    reg is_closing;             // SEQUENCE becomes even
    reg [62:0] updates;
    reg [63:0] word;
    always @* case (at)
        0: word = {updates, !is_closing};
        1: word = now;
        2: word = {47'd0, status};
        3: word = count;
        4: word = phase;
        5: word = velocity;
        6: word = run;
        7: word = frame;
        8: word = trigger_count;
        9: word = count;        // there is no encoder
        10: word = segment_tail;
        11: word = capture_head;
        12: word = capture_lost;
        13: word = capture_sum;
        14: word = capture_sums;
        15: word = setup;
        16: word = {32'd0, inputs};
        17: word = {48'd0, outputs};
        18: word = output_tail;
        19: word = event_head;
        20: word = event_lost;
        22: word = analog[63:0];
        23: word = analog[127:64];
        default: word = 0;      // there are no pulses at places
    endcase

    integer i;
    initial begin
        {busy, at, is_closing, updates, is_published} = 0;
        for (i = 0; i < 32; i = i + 1) words[i] = 0;
    end
    always @(posedge clk) begin
        if (busy) words[at] <= word;
        read_word <= words[read_word_number];
    end
    always @(posedge clk) begin
        if (publish && !hold) busy <= 1;
        if (busy) begin
            at <= at == LAST || is_closing ? 5'd0 : at + 1'b1;
            is_closing <= at == LAST;
            if (at == LAST) updates <= updates + 1'b1;
            if (is_closing) begin
                busy <= 0;
                is_published <= 1;
            end
        end
    end
endmodule
