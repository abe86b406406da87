// The device's adder. What it adds and counts is in memory: the motor's velocity and phase, the sums and the counters
// of the map, and the values of the analog outputs. It does one thing at a time, in some clocks:
// - It is the step engine, core/step/tick_engine.hpp: velocity += acceleration and phase += velocity at each tick.
//   PHASE is position + 1/2 step modulo one step; a step forward is the carry of phase + velocity, a step backward its
//   borrow.
// - It notes a step, a trigger, a setup or an event.
// - It moves the analog outputs by their slopes.
// - It publishes the words, which are all of one state then. SEQUENCE is odd meanwhile. While `hold` is high, the words
//   stay as they are: a host behind a slow link then reads one consistent state, however long that takes.
module axis_adder #(
    parameter CAPTURE_BITS = 8, // 2 to the power of it is the number of entries
    parameter EVENT_BITS = 4,
    parameter SEGMENT_BITS = 8,
    parameter OUTPUT_BITS = 5,
    parameter ANALOG = 2        // at most 8
) (
    input clk,
    output busy,                // something is being noted or moved; what is shown stays as it is
    // What the sequencer waits for, until `done`.
    input power_up,             // TICK becomes first_tick
    input [63:0] first_tick,
    input load,                 // a piece
    output reg [1:0] entry_field, // the word of the piece, or of the next frame's header, in the segment ring
    input [63:0] entry_word,    // a clock later
    input advance,              // TICK
    input accelerate,           // and the motor: first half of a tick
    input travel,               // second half of a tick
    input check,                // the next frame
    output reg done,
    // A check shows of the next frame, from the clock after `done` on:
    output reg is_past,         // it starts now or before
    output reg is_now,
    output reg is_place,        // it starts at COUNT
    output reg is_same_phase,   // it starts at PHASE
    output reg is_rest_phase,   // it starts at a whole step
    // At once.
    input rebase,               // at rest: takes the checked frame's phase, for one clock
    input rest,                 // or that of a whole step
    input halt,                 // drops the rest of the piece
    // The engine.
    output idle,                // there is no piece, or it has ended
    output reg overflow,        // after `accelerate`: the velocity left 64 bits
    output reg engine_step,     // for the clock after `travel`: the tick makes a step
    output reg backward,        // its direction
    // A step, for one clock.
    input step,
    input forward,
    input [CAPTURE_BITS:0] capture_tail, // low bits of CAPTURE_TAIL
    output capture_full,
    // A run ends by its trigger, for one clock.
    input triggered,
    // A setup was taken, for one clock. In the clock after `asks_request`, host_word is SETUP_REQUEST.
    input setup_taken,
    output asks_request,
    input [63:0] host_word,
    // An event, for one clock while it is not busy.
    input put,
    input [1:0] kind,           // as in WHAT
    input [4:0] channel,
    input [15:0] levels,
    // What it gives an analog output: axis_outputs.v.
    input gives_value,
    input keeps_value,
    input gives_slope,
    output asks_slope,
    output reg [7:0] has_slope,
    output reg [7:0] is_zero,
    input [EVENT_BITS:0] event_tail, // low bits of EVENT_TAIL
    // A tick, for one clock.
    input tick,
    output [127:0] analog,      // what they show: 16 bits each, of 2^-15 of full scale
    // The words are published, for one clock.
    input publish,
    input hold,
    output reg publish_busy,
    output reg is_published,    // since power-up
    input [16:0] status,
    input [63:0] run,
    input [63:0] frame,
    input [SEGMENT_BITS:0] segment_tail, // low bits
    input [31:0] inputs,
    input [15:0] outputs,
    input [OUTPUT_BITS:0] output_tail,
    // The host reads, a clock after the address.
    input reads_event,
    input [EVENT_BITS+1:0] read_event,
    input [4:0] read_word_number,
    output [63:0] read_word,    // of the map, or of the event ring
    input [CAPTURE_BITS-1:0] read_entry,
    output [63:0] read_step
);
    // The words that are counted: those of the map by their numbers, from 0x0100 on, and others.
    localparam [5:0] SEQUENCE = 0, NOW = 1, COUNT = 3, PHASE = 4, VELOCITY = 5, TRIGGER_COUNT = 8, ENCODER = 9,
        SEGMENT_TAIL = 10, CAPTURE_HEAD = 11, CAPTURE_LOST = 12, CAPTURE_SUM = 13, CAPTURE_SUMS = 14, SETUP = 15,
        OUTPUT_TAIL = 18, EVENT_HEAD = 19, EVENT_LOST = 20, LAST = 23, ACCELERATION = 24, FRAME_PHASE = 25,
        REST_PHASE = 26, ZERO = 31;
    localparam [1:0] VALUES = 2, SLOPES = 3; // of the analog outputs: {one of them, 1'b0, output}
    // The other words that are published, put into a ring, or added.
    localparam [5:0] STATUS = 2, RUN = 6, FRAME = 7, INPUTS = 16, OUTPUTS = 17, ANALOG_LOWER = 22, ANALOG_UPPER = 23,
        WHAT = 32, STEP = 33, SEGMENTS_TAKEN = 34, OUTPUTS_TAKEN = 35, HOST = 36, SIGN = 37, ENTRY = 38,
        FIRST_TICK = 39;
    localparam [5:0] REST = 0, STEP_HEAD = 1, STEP_LOST = 2, STEP_COUNT = 3, STEP_TICK = 4, STEP_SUM = 5, STEP_SUMMED
        = 6, STEP_SUMS = 7, NOTE_TICK = 8, NOTE_WHAT = 9, NOTE_VALUE = 10, NOTE_DETAIL = 11, STEP_END = 12, NOTE_HEAD
        = 13, GIVE_VALUE = 14, GIVE_SLOPE = 15, OPEN = 16, OPENED = 17, TAKE_SEGMENTS = 18, SEGMENTS_TAKE = 19,
        TAKE_OUTPUTS = 20, OUTPUTS_TAKE = 21, BEGIN = 22, SHOW = 23, SLOPE_GIVEN = 24, SLIDE = 25, SLIDE_SLOPE = 26,
        SLIDE_VALUE = 27, ASK_SETUP = 28, TAKE_SETUP = 29, SETUP_TAKEN = 30, TRIGGER = 31, TRIGGERED = 32, LOAD = 33,
        LOAD_VELOCITY = 34, LOAD_ACCELERATION = 35, ADVANCE = 36, ACCELERATE = 37, ACCELERATED = 38, TRAVEL = 39,
        TRAVELLED = 40, CHECK_START = 41, CHECK_PAST = 42, CHECK_COUNT = 43, CHECK_PHASE = 44, CHECKED = 45, REBASE =
        46, REBASED = 47, POWER_UP = 48;
    reg [5:0] state, next;
    reg asks_step, asks_trigger, asks_event, asks_slide, asks_setup, asks_rebase;
    reg to_rest;                // the motor's phase becomes that of a whole step
    reg [31:0] left;            // ticks of the present piece
    reg goes_forward;           // the step
    reg [1:0] its_kind;         // the event
    reg [4:0] its_channel;
    reg [15:0] its_levels;
    reg [2:0] output_at;        // the analog output
    reg [ANALOG-1:0] slides_left;
    reg [5:0] number;           // the word that is published
    reg is_closing;             // SEQUENCE becomes even

    // The adder: a counted word and an addend. The sum becomes that word if `counts`.
    (* no_rw_check *) reg [63:0] counted[0:63];
    reg [5:0] asked, read;      // the counted word, and that of the next clock
    reg [5:0] counts_as;
    reg [63:0] counted_word, addend;
    reg counts, carry, adds, inverts; // `adds`: `word` is the next clock's addend; `inverts`: it is inverted
    wire [64:0] sum = {1'b0, counted_word} + {1'b0, addend} + {64'd0, carry};
    wire is_nothing = addend == 0;
    wire is_analog = state == SLIDE_VALUE || state == GIVE_SLOPE;
    wire is_below = is_analog && addend[63] && !sum[64];
    wire is_full = is_analog && !addend[63] && sum[63:62] != 0;
    wire [63:0] kept = is_below || is_full ? {1'b0, is_full, 62'd0} : sum[63:0];

    wire [SEGMENT_BITS:0] segments_taken = segment_tail - counted_word[SEGMENT_BITS:0];
    wire [OUTPUT_BITS:0] outputs_taken = output_tail - counted_word[OUTPUT_BITS:0];
    reg [5:0] select;
    reg [63:0] word;            // that is published, put into a ring, or added
    wire is_equal = word == counted_word;
    always @* case (select)
        STATUS: word = {47'd0, status};
        RUN: word = run;
        FRAME: word = frame;
        HOST: word = host_word;
        SIGN: word = {64{!goes_forward}};
        ENTRY: word = entry_word;
        FIRST_TICK: word = first_tick;
        INPUTS: word = {32'd0, inputs};
        OUTPUTS: word = {48'd0, outputs};
        ANALOG_LOWER: word = analog[63:0];
        ANALOG_UPPER: word = analog[127:64];
        WHAT: word = {32'd0, its_levels, 3'd0, its_channel, 6'd0, its_kind};
        SEGMENTS_TAKEN: word = {{(63 - SEGMENT_BITS){1'b0}}, segments_taken};
        OUTPUTS_TAKEN: word = {{(63 - OUTPUT_BITS){1'b0}}, outputs_taken};
        STEP: word = {counted_word[62:0], goes_forward};
        default: word = counted_word;
    endcase

    wire was_full, is_lost;     // the step or the event is lost
    reg shows;                  // `word` is put where the host reads it
    axis_shown #(.CAPTURE_BITS(CAPTURE_BITS), .EVENT_BITS(EVENT_BITS)) shown (.clk(clk), .word(word), .step(step),
        .capture_tail(capture_tail), .capture_full(capture_full), .step_is_lost(was_full),
        .puts_step(state == STEP_TICK && !was_full), .note(put), .event_tail(event_tail), .note_is_lost(is_lost),
        .puts_note(shows && state != SHOW), .note_field(state[1:0]), .puts_word(shows), .number(number[4:0]),
        .reads_event(reads_event), .read_event(read_event), .read_word_number(read_word_number),
        .read_word(read_word), .read_entry(read_entry), .read_step(read_step));
    assign idle = left == 0;
    assign asks_request = state == ASK_SETUP;
    assign asks_slope = state == GIVE_VALUE;
    assign busy = asks_step || asks_slide || asks_trigger || asks_event || asks_setup || asks_rebase ||
        (state != REST && (state < OPEN || state > SHOW) && state < LOAD) || state == REBASE || state == REBASED;

    // What it does in each state: a word that is read is there in the next one.
    always @* begin
        next = REST;
        read = ZERO;
        select = ZERO;
        counts_as = asked;
        {counts, carry, adds, inverts, shows, done} = 0;
        entry_field = 1;
        case (state)
            REST: if (asks_rebase) begin
                next = REBASE;
                read = to_rest ? REST_PHASE : FRAME_PHASE;
            end else if (asks_step) begin
                next = STEP_HEAD;
                read = CAPTURE_HEAD;
            end else if (asks_slide) begin
                next = SLIDE;
            end else if (asks_trigger) begin
                next = TRIGGER;
                read = COUNT;
            end else if (asks_event) begin
                next = NOTE_HEAD;
                read = EVENT_HEAD;
            end else if (asks_setup) begin
                next = ASK_SETUP;
            end else if (load) begin
                next = LOAD;
            end else if (advance) begin
                next = ADVANCE;
                read = NOW;
            end else if (travel) begin
                next = TRAVEL;
                read = VELOCITY;
            end else if (check) begin
                next = CHECK_START;
                read = NOW;
            end else if (power_up) begin
                next = POWER_UP;
                select = FIRST_TICK;
                adds = 1;
            end else if (publish_busy) begin
                next = OPEN;
                read = SEQUENCE;
            end
            POWER_UP: begin counts = 1; counts_as = NOW; done = 1; end
            REBASE: begin next = REBASED; adds = 1; end
            REBASED: begin counts = 1; counts_as = PHASE; end
            LOAD: begin entry_field = 2; next = LOAD_VELOCITY; select = ENTRY; adds = 1; end
            LOAD_VELOCITY: begin
                entry_field = 0;
                next = LOAD_ACCELERATION;
                counts = 1;
                counts_as = VELOCITY;
                select = ENTRY;
                adds = 1;
            end
            LOAD_ACCELERATION: begin counts = 1; counts_as = ACCELERATION; done = 1; end
            ADVANCE: begin
                next = accelerate ? ACCELERATE : REST;
                counts = 1;
                carry = 1;
                read = ACCELERATION;
                done = !accelerate;
            end
            ACCELERATE: begin next = ACCELERATED; adds = 1; read = VELOCITY; end
            ACCELERATED: begin counts = 1; done = 1; end
            TRAVEL: begin next = TRAVELLED; adds = 1; read = PHASE; end
            TRAVELLED: begin counts = 1; done = 1; end
            CHECK_START: begin
                next = CHECK_PAST;
                select = ENTRY;
                adds = 1;
                inverts = 1;
                read = NOW;
                entry_field = 2;
            end
            CHECK_PAST: begin next = CHECK_COUNT; carry = 1; read = COUNT; entry_field = 2; end
            CHECK_COUNT: begin next = CHECK_PHASE; select = ENTRY; read = PHASE; entry_field = 3; end
            CHECK_PHASE: begin next = CHECKED; select = ENTRY; adds = 1; end
            CHECKED: begin counts = 1; counts_as = FRAME_PHASE; done = 1; end
            STEP_HEAD: begin next = STEP_LOST; counts = 1; carry = !was_full; read = CAPTURE_LOST; end
            STEP_LOST: begin next = STEP_COUNT; counts = 1; carry = was_full; select = SIGN; adds = 1; read = COUNT; end
            STEP_COUNT: begin next = STEP_TICK; counts = 1; carry = goes_forward; read = NOW; end
            STEP_TICK: begin next = STEP_SUM; select = STEP; adds = 1; read = CAPTURE_SUM; end
            STEP_SUM: begin next = STEP_SUMMED; counts = 1; end
            STEP_SUMMED: begin next = STEP_SUMS; read = CAPTURE_SUM; end
            STEP_SUMS: begin next = STEP_END; adds = 1; read = CAPTURE_SUMS; end
            STEP_END: counts = 1;
            TRIGGER: begin next = TRIGGERED; adds = 1; end
            TRIGGERED: begin counts = 1; counts_as = TRIGGER_COUNT; end
            NOTE_HEAD: begin next = NOTE_TICK; counts = 1; carry = !is_lost; read = NOW; end
            NOTE_TICK: begin next = NOTE_WHAT; shows = !is_lost; read = EVENT_LOST; end
            NOTE_WHAT: begin
                next = its_kind == 2 ? GIVE_VALUE : NOTE_VALUE;
                counts = 1;
                carry = is_lost;
                select = WHAT;
                shows = !is_lost;
                read = its_kind != 2 ? COUNT : keeps_value ? {VALUES, 1'b0, its_channel[2:0]} : ZERO;
            end
            GIVE_VALUE: begin next = GIVE_SLOPE; select = gives_value ? HOST : ZERO; adds = 1; end
            GIVE_SLOPE: begin
                next = SLOPE_GIVEN;
                counts = 1;
                counts_as = {VALUES, 1'b0, its_channel[2:0]};
                select = gives_slope ? HOST : ZERO;
                adds = 1;
            end
            SLOPE_GIVEN: begin
                next = NOTE_VALUE;
                counts = 1;
                counts_as = {SLOPES, 1'b0, its_channel[2:0]};
                read = {VALUES, 1'b0, its_channel[2:0]};
            end
            NOTE_VALUE: begin
                next = NOTE_DETAIL;
                shows = !is_lost;
                read = its_kind == 2 ? {SLOPES, 1'b0, its_channel[2:0]} : its_kind == 0 ? PHASE : ZERO;
            end
            NOTE_DETAIL: shows = !is_lost;
            SLIDE: if (slides_left != 0) begin
                next = slides_left[0] ? SLIDE_SLOPE : SLIDE;
                read = {SLOPES, 1'b0, output_at};
            end
            SLIDE_SLOPE: begin next = SLIDE_VALUE; adds = 1; read = {VALUES, 1'b0, output_at}; end
            SLIDE_VALUE: begin next = SLIDE; counts = 1; end
            ASK_SETUP: next = TAKE_SETUP;
            TAKE_SETUP: begin next = SETUP_TAKEN; select = HOST; adds = 1; end
            SETUP_TAKEN: begin counts = 1; counts_as = SETUP; end
            OPEN: begin next = OPENED; counts = 1; carry = 1; end
            OPENED: begin next = is_closing ? SHOW : TAKE_SEGMENTS; read = is_closing ? SEQUENCE : SEGMENT_TAIL; end
            TAKE_SEGMENTS: begin next = SEGMENTS_TAKE; select = SEGMENTS_TAKEN; adds = 1; read = SEGMENT_TAIL; end
            SEGMENTS_TAKE: begin next = TAKE_OUTPUTS; counts = 1; read = OUTPUT_TAIL; end
            TAKE_OUTPUTS: begin next = OUTPUTS_TAKE; select = OUTPUTS_TAKEN; adds = 1; read = OUTPUT_TAIL; end
            OUTPUTS_TAKE: begin next = BEGIN; counts = 1; end
            BEGIN: begin next = SHOW; read = SEQUENCE; end
            SHOW: begin
                next = is_closing ? REST : number == LAST ? OPEN : SHOW;
                select = number;
                shows = 1;
                case (number + 1'b1)
                    LAST + 1'b1: read = SEQUENCE;
                    VELOCITY: read = idle ? ZERO : VELOCITY;
                    ENCODER: read = COUNT; // there is no encoder
                    default: read = number + 1'b1;
                endcase
            end
            default: ;
        endcase
    end

    genvar n;
    generate for (n = 0; n < 8; n = n + 1) begin : outputs_shown
        if (n < ANALOG) begin : value
            reg [15:0] level;
            initial level = 0;
            always @(posedge clk) if (counts && counts_as == {VALUES, 4'd0} + n) level <= kept[62:47];
            assign analog[16*n +: 16] = level;
        end else begin : none
            assign analog[16*n +: 16] = 0;
        end
    end endgenerate
    integer i;
    initial begin
        {state, asks_step, asks_trigger, asks_event, goes_forward, its_kind, its_channel, its_levels} = 0;
        {number, is_closing, asked, counted_word, addend} = 0;
        {publish_busy, is_published, asks_slide, output_at, slides_left, asks_setup, has_slope} = 0;
        is_zero = 8'hff;
        {is_past, is_now, is_place, is_same_phase, is_rest_phase} = 0;
        {overflow, engine_step, backward, asks_rebase, to_rest, left} = 0;
        for (i = 0; i < 64; i = i + 1) counted[i] = 0;
        counted[PHASE] = 64'd1 << 63;
        counted[REST_PHASE] = 64'd1 << 63;
    end
    always @(posedge clk) begin
        if (counts) counted[counts_as] <= kept;
        counted_word <= counted[read];
        asked <= read;
        addend <= adds ? word ^ {64{inverts}} : 64'd0;
    end
    always @(posedge clk) begin
        state <= next;
        asks_step <= step || (asks_step && (state != REST || asks_rebase));
        asks_slide <= tick ? has_slope[ANALOG-1:0] != 0 : asks_slide && (state != REST || asks_rebase || asks_step);
        asks_trigger <= triggered || (asks_trigger && (state != REST || asks_rebase || asks_step || asks_slide));
        asks_event <= put || (asks_event && (state != REST || asks_rebase || asks_step || asks_slide || asks_trigger));
        asks_setup <= setup_taken || (asks_setup && state != TAKE_SETUP);
        if (step) begin
            goes_forward <= forward;
        end
        if (put) begin
            its_kind <= kind;
            its_channel <= channel;
            its_levels <= levels;
        end
        if (state == REST) begin
            slides_left <= has_slope[ANALOG-1:0];
            output_at <= 0;
        end else if ((state == SLIDE && !slides_left[0]) || state == SLIDE_VALUE) begin
            slides_left <= slides_left >> 1;
            output_at <= output_at + 1'b1;
        end
        if (state == GIVE_SLOPE) is_zero[its_channel[2:0]] <= is_nothing || is_below;
        if (state == SLOPE_GIVEN) has_slope[its_channel[2:0]] <= !is_nothing;
        asks_rebase <= rebase || (asks_rebase && state != REST);
        if (rebase) to_rest <= rest;
        if (halt) left <= 0;
        else if (state == LOAD_ACCELERATION) left <= entry_word[39:8];
        else if (state == TRAVELLED) left <= left - 1'b1;
        if (state == ACCELERATED) overflow <= addend[63] == counted_word[63] && sum[63] != addend[63];
        if (state == TRAVELLED) backward <= addend[63];
        engine_step <= state == TRAVELLED && sum[64] != addend[63];
        if (state == CHECK_START) is_now <= is_equal;
        if (state == CHECK_PAST) is_past <= addend[63] == counted_word[63] ? !addend[63] : sum[64]; // signed
        if (state == CHECK_COUNT) is_place <= word[31:0] == counted_word[31:0];
        if (state == CHECK_PHASE) begin
            is_same_phase <= is_equal;
            is_rest_phase <= word[63] ? word[62:0] == 0 : word[62:0] == ~63'd0;
        end
        if (publish && !hold) publish_busy <= 1;
        if (state == SHOW) begin
            number <= number == LAST || is_closing ? 6'd0 : number + 1'b1;
            is_closing <= number == LAST;
            if (is_closing) begin
                publish_busy <= 0;
                is_published <= 1;
            end
        end
    end
endmodule
