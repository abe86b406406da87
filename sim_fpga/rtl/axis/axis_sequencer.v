// Runs the frames of one motor: what begins at which tick, and what ends it. It is SimulatedDevice of
// sim_fpga/device.hpp, where the rules are.
//
// The work of a tick: the host's orders, then the inputs and the decisions of the present tick, then the tick itself,
// then the inputs and the decisions after it, then the registers for the host. `busy` lasts as long as this work. A
// tick that comes meanwhile waits. If it comes in motion and before the present tick's step, that step would come to
// the pin too late, so the run ends, with LOST_TICKS.
module axis_sequencer #(
    parameter INPUTS = 8,
    parameter ENTRY_BITS = 8,   // of the segment ring
    parameter SETTLE_CLOCKS = 8 // how long a decision waits for axis_frame_scanner.v; then there is no good frame
) (
    input clk,
    input tick,                 // for one clock
    output busy,
    output ticks,               // for one clock: the tick is executed
    // The host's words.
    input [63:0] run_request,
    input [32:0] trigger_request,
    input [63:0] armed,
    input [63:0] veto,
    input [63:0] stop,
    input enable,
    input setup_is_new,         // there is a new SETUP_REQUEST
    // The setup.
    output start_setup,
    input setup_busy,
    input setup_taken,
    input setup_refused,
    input [31:0] enable_ticks,
    input [INPUTS-1:0] limit_min,
    input [INPUTS-1:0] limit_max,
    input [INPUTS-1:0] home,
    input [INPUTS-1:0] stop_inputs,
    input disables_at_silence,
    // The inputs and the host's beat.
    output look,
    input inputs_busy,
    input [INPUTS-1:0] closed,
    output look_at_host,
    output judge_host,
    input falls_silent,
    input is_host_silent,
    // The outputs.
    output direct_outputs,
    output due_outputs,
    output silence_outputs,
    output end_outputs,
    output is_cut,
    output begins_body,
    output begins_tail,
    output changes_run,         // for one clock: a run begins or ends
    input outputs_busy,
    input outputs_settled,      // those of the next frame are known
    input outputs_well,
    output at_rest,
    output in_motion,
    // The next frame.
    output drop_own,
    output drop_others,
    output take,
    input frame_settled,
    input frame_valid,
    input frame_good,
    input [ENTRY_BITS:0] frame_at,
    input frame_is_last,
    input frame_is_of_run,
    input [31:0] frame_number,
    input [15:0] frame_body_pieces,
    input [15:0] frame_tail_pieces,
    // The pieces, and the engine that runs them: axis_adder.v. It does these until `done`.
    output power_up,
    output load,
    output reg [ENTRY_BITS-1:0] piece, // the present one in the ring
    output advance,
    output accelerate,
    output travel,
    output check,
    input done,
    input is_past,              // of the next frame, when it is checked
    input is_now,
    input is_place,
    input is_same_phase,
    input is_rest_phase,
    output halt,
    output rebase,
    output rest,
    input idle,
    input overflow,
    input engine_step,          // a clock after `done` of the travel
    input engine_backward,
    // The steps.
    output step,                // for one clock
    output forward,
    input capture_full,
    // The registers.
    output publish,             // for one clock
    input publish_busy,
    output [16:0] status,
    output reg [63:0] run,
    output reg [63:0] frame,
    output triggered,           // for one clock: the run ends by its trigger
    output [ENTRY_BITS:0] segment_tail, // low bits
    output enabled              // the motor is
);
    localparam AT_REST = 0, WAITING = 1, BODY = 2, TAIL = 3;
    localparam POWER_UP = 0, IDLE = 1, SETUP = 2, TAKE_SETUP = 3, ENABLE = 4, RUN = 5, CEASE = 6, LOOK = 7, TEND = 8,
        TENDED = 9, DECIDE = 10, SETTLE = 11, ACT = 12, FETCH = 13, ACCELERATE = 14, TRAVEL = 15, STEP = 16,
        PUBLISH = 17, PUBLISHED = 18, OUTPUTS = 19, DIRECT = 20, DUE = 21, JUDGE = 22;
    // The bits of STATUS that a new run clears.
    localparam [15:0] FINISHED = 1 << 1, ENDED_IN_TAIL = 1 << 2, BY_LIMIT = 1 << 6, BY_TRIGGER = 1 << 7,
        BY_HOST = 1 << 8, BAD_SEGMENT = 1 << 9, OVERFLOWS = 1 << 10, BY_INPUT = 1 << 13,
        BAD_OUTPUT = 1 << 15;
    localparam [8:0] MOST_WAITED = SETTLE_CLOCKS;

    wire is_settled = frame_settled && outputs_settled;
    reg [4:0] state, next, back; // `back`: when the outputs have changed
    reg [7:0] owed;             // ticks that have come and are not executed
    reg has_lost_ticks;
    reg is_after;               // the tick of this work has been executed
    reg [1:0] motion;
    reg [8:0] waited;
    reg [32:0] trigger;
    reg [15:0] run_bits;
    reg is_last;
    reg [15:0] body_left, tail_left; // pieces, with the present one
    reg [ENTRY_BITS:0] frame_begin;     // where the present frame begins in the ring
    reg is_checking;            // the next frame
    reg is_set_up, is_refused;  // a setup was taken; the last one was refused
    reg is_enabled;
    reg [31:0] enabled_for;
    reg stepped, stepped_backward, into_limit; // in this tick

    assign in_motion = motion == BODY || motion == TAIL;
    assign at_rest = motion == AT_REST;
    wire run_is_new = run_request != 0 && run_request != run;
    wire takes_run = run_is_new && ((state == RUN && !in_motion) || (state == DECIDE && motion == AT_REST));
    wire is_stop_asked = stop != 0 && stop == run_request;
    wire may_enable = enable && !(is_host_silent && disables_at_silence);
    wire may_move = !has_lost_ticks && is_set_up && is_enabled && enabled_for >= enable_ticks;

    // The next frame: 1 while the run waits for it. What SETTLE compares in its last clock, ACT decides about.
    reg [63:0] number;
    reg is_vetoed, is_armed, is_of_request, is_number;
    always @(posedge clk) begin
        number <= frame + 1'b1;
        is_vetoed <= veto <= number;
        is_armed <= armed >= number;
        is_of_request <= run_request == run;
        is_number <= frame_number == number[31:0];
    end
    wire may_run = !is_vetoed && is_armed && is_of_request && may_move;
    wire is_here = is_now && is_place;
    wire joins = is_number && is_here && (is_same_phase || (motion == WAITING && is_rest_phase));
    wire is_good = frame_good && frame_valid;

    wire [INPUTS-1:0] of_trigger = trigger[INPUTS-1:0] & closed;
    wire is_triggered = trigger[31:0] != 0 && (of_trigger != 0) != trigger[32];
    wire is_stopped = (closed & stop_inputs) != 0;
    wire at_min = (closed & limit_min) != 0, at_max = (closed & limit_max) != 0;
    wire is_blocked = engine_backward ? at_min : at_max;
    wire at_limit = into_limit || (stepped && (stepped_backward ? at_min : at_max));

    // The decisions of the state ACT. When a body ends, the next frame begins, or the tail begins, or the run ends.
    wire begins_run = motion == WAITING && frame_valid && !is_vetoed && is_past && may_run;
    wire starts = begins_run && joins && is_good;
    wire is_piece_over = state == ACT && in_motion && idle;
    wire is_body_over = is_piece_over && motion == BODY && body_left == 1;
    wire is_next = is_body_over && !is_last && frame_valid && frame_is_of_run && is_number && may_run;
    wire follows = is_next && joins && is_good;
    assign begins_tail = is_body_over && !is_last && !follows && tail_left != 0;
    wire goes_on = is_piece_over && (motion == BODY ? body_left != 1 : tail_left != 1);
    wire begins_frame = (state == ACT && starts && !is_stopped && !is_triggered) || follows;

    // Why the run ends in this clock.
    reg ends;
    reg [15:0] reason;
    always @* begin
        ends = 0;
        reason = 0;
        case (state)
            ENABLE, TENDED: begin
                ends = in_motion && is_enabled && !may_enable && (state == ENABLE || is_host_silent);
                reason = BY_HOST;
            end
            CEASE: begin
                ends = motion != AT_REST && (is_stop_asked || has_lost_ticks);
                reason = is_stop_asked ? BY_HOST : 16'd0;
            end
            TEND: begin
                reason = (at_limit ? BY_LIMIT : 16'd0) | (is_triggered ? BY_TRIGGER : 16'd0) |
                    (is_stopped ? BY_INPUT : 16'd0);
                ends = in_motion && !inputs_busy && reason != 0;
            end
            TRAVEL: begin
                ends = in_motion && overflow;
                reason = BAD_SEGMENT;
            end
            ACT: if (motion == WAITING) begin
                ends = frame_valid && (is_vetoed || (begins_run && !begins_frame));
                reason = is_vetoed ? 16'd0 : !starts ? BAD_SEGMENT : is_stopped ? BY_INPUT : BY_TRIGGER;
            end else begin
                ends = is_piece_over && !goes_on && !follows && !begins_tail;
                reason = is_next ? BAD_SEGMENT : 16'd0;
            end
            default: ;
        endcase
    end

    assign busy = state != IDLE || owed != 0;
    wire is_before_step = state != IDLE && (!is_after || state == STEP);
    assign start_setup = state == SETUP && setup_is_new && !in_motion;
    assign look = state == LOOK;
    assign look_at_host = state == ENABLE;
    assign judge_host = state == JUDGE;
    assign direct_outputs = state == DIRECT;
    assign due_outputs = state == DUE;
    assign silence_outputs = falls_silent;
    assign end_outputs = ends;
    assign is_cut = reason != 0 || motion != BODY || !is_last;
    assign begins_body = begins_frame;
    assign drop_own = state == SETTLE && motion == AT_REST;
    assign drop_others = state == SETTLE && motion == WAITING;
    assign take = state == ACT && (starts || follows);
    assign rebase = (state == ACT && begins_run && joins) || (ends && into_limit);
    assign rest = into_limit;
    assign halt = ends;
    assign changes_run = ends || takes_run;
    assign triggered = ends && reason[7];
    assign load = state == FETCH;
    assign power_up = state == POWER_UP;
    assign advance = state == ACCELERATE;
    assign accelerate = in_motion;
    assign travel = state == TRAVEL && in_motion && !overflow;
    assign check = state == SETTLE && (is_settled || waited == MOST_WAITED || is_checking);
    assign step = state == STEP && engine_step && !is_blocked;
    assign forward = !engine_backward;
    assign publish = state == PUBLISH;
    assign ticks = state == TRAVEL && (done || !travel);
    assign enabled = is_enabled;
    assign segment_tail = in_motion ? frame_begin : frame_at;

    wire bad_setup = is_refused && !setup_is_new;
    assign status = {1'b0, run_bits} | {has_lost_ticks, 1'b0, bad_setup, 1'b0, is_host_silent, is_enabled, 5'd0,
        (closed & home) != 0, at_max, at_min, motion == TAIL, 1'b0, in_motion};

    initial begin
        state = POWER_UP;
        back = IDLE;
        {owed, has_lost_ticks, is_after, motion, waited, trigger, run_bits, is_last, body_left, tail_left} = 0;
        {piece, frame_begin} = 0;
        {is_set_up, is_refused, is_enabled, enabled_for, stepped, stepped_backward, into_limit} = 0;
        {number, is_vetoed, is_armed, is_of_request, is_number} = 0;
        {run, frame, is_checking} = 0;
    end

    // The order of work.
    always @(posedge clk) begin
        owed <= owed + {7'd0, tick} - {7'd0, state == IDLE && owed != 0};
        if (tick && in_motion && (owed != 0 || is_before_step)) has_lost_ticks <= 1;
        waited <= state != SETTLE ? 9'd0 : waited + {8'd0, waited != MOST_WAITED};
        is_checking <= check;
        if (state == IDLE) is_after <= 0;
        else if (ticks) is_after <= 1;
        state <= asks ? OUTPUTS : next;
        if (asks) back <= next;
    end

    // The outputs do what they are asked for before the work goes on.
    wire asks = ends || state == DIRECT || state == DUE || falls_silent;
    always @* case (state)
        POWER_UP: next = done ? PUBLISH : POWER_UP;
        IDLE: next = owed != 0 ? SETUP : IDLE;
        SETUP: next = start_setup ? TAKE_SETUP : ENABLE;
        TAKE_SETUP: next = setup_busy ? TAKE_SETUP : ENABLE;
        ENABLE: next = DIRECT;
        DIRECT: next = RUN;
        RUN: next = CEASE;
        CEASE: next = DUE;
        DUE: next = JUDGE;
        JUDGE: next = LOOK;
        LOOK: next = TEND;
        TEND: next = inputs_busy ? TEND : TENDED;
        TENDED: next = DECIDE;
        DECIDE: next = !in_motion || idle ? SETTLE : is_after ? PUBLISH : ACCELERATE;
        SETTLE: next = done ? ACT : SETTLE;
        ACT: next = begins_frame || begins_tail || goes_on ? FETCH : is_after ? PUBLISH : ACCELERATE;
        FETCH: next = !done ? FETCH : is_after ? PUBLISH : ACCELERATE;
        ACCELERATE: next = done ? TRAVEL : ACCELERATE;
        TRAVEL: next = done || !travel ? STEP : TRAVEL;
        STEP: next = DUE;
        PUBLISH: next = PUBLISHED;
        PUBLISHED: next = publish_busy ? PUBLISHED : IDLE;
        OUTPUTS: next = outputs_busy ? OUTPUTS : back;
        default: next = IDLE;
    endcase

    // The setup and the motor's enable.
    always @(posedge clk) begin
        if (setup_taken) is_set_up <= 1;
        if (setup_taken || setup_refused) is_refused <= setup_refused;
        if (state == ENABLE || (state == TENDED && is_host_silent)) is_enabled <= may_enable;
        if (!is_enabled) enabled_for <= 0;
        else if (ticks && enabled_for != 32'hffffffff) enabled_for <= enabled_for + 1'b1;
    end

    // The run, its frames and its pieces.
    always @(posedge clk) begin
        if (ends) begin
            motion <= AT_REST;
            run_bits <= run_bits | FINISHED | reason | (motion == TAIL ? ENDED_IN_TAIL : 16'd0);
        end else if (takes_run) begin
            motion <= WAITING;
            run <= run_request;
            trigger <= trigger_request;
            run_bits <= 0;
            frame <= 0;
        end else if (begins_frame) begin
            if (!outputs_well) run_bits <= run_bits | BAD_OUTPUT;
            motion <= BODY;
            frame <= number;
            is_last <= frame_is_last;
            body_left <= frame_body_pieces;
            tail_left <= frame_tail_pieces;
            frame_begin <= frame_at;
            piece <= frame_at[ENTRY_BITS-1:0] + 1'b1;
        end else if (begins_tail || goes_on) begin
            piece <= piece + 1'b1;
            if (begins_tail) motion <= TAIL;
            else if (motion == BODY) body_left <= body_left - 1'b1;
            else tail_left <= tail_left - 1'b1;
            if (begins_tail && is_next) run_bits <= run_bits | BAD_SEGMENT;
        end else if (step && capture_full) begin
            run_bits <= run_bits | OVERFLOWS;
        end
    end

    // The steps.
    always @(posedge clk) begin
        if (state == STEP) begin
            stepped <= engine_step && !is_blocked;
            stepped_backward <= engine_backward;
            into_limit <= engine_step && is_blocked;
        end else if (state == TENDED) {stepped, into_limit} <= 0;
    end
`ifdef PROOF
`include "axis_sequencer_properties.vh"
`endif
endmodule
