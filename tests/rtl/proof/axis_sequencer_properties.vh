    // What axis_sequencer.v promises, for any host, frames, pieces, inputs and times. tests/rtl/proof/prove_axis proves
    // it. Each property is derived from the rules at the head of sim_fpga/device.hpp.
    reg [1:0] was;              // `motion`, a clock ago
    reg [63:0] was_run, was_frame;
    reg was_armed;              // the host's words allowed a frame to begin, a clock ago
    reg may_begin;              // they did a clock before, and the motor a clock ago
    reg must_rest;              // the run had to end
    reg body_ended, has_tail;
    reg is_permitted;           // the present frame could begin when it did
    reg travelled;              // a clock ago
    reg has_travelled;          // in this tick
    initial begin
        {was, was_run, was_frame, was_armed, may_begin, must_rest, body_ended, has_tail, is_permitted, travelled} = 0;
        has_travelled = 0;
    end

    wire [63:0] following = frame + 1;
    wire is_allowed = armed >= following && veto > following && run_request == run;
    wire has_motor = is_set_up && is_enabled;
    wire begins = motion == BODY && (was != BODY || frame != was_frame);
    wire stops = (state == CEASE && stop != 0 && stop == run_request) || (state == ENABLE && !enable && is_enabled) ||
        (state == TEND && !inputs_busy && (closed & stop_inputs) != 0 && in_motion);
    always @(posedge clk) begin
        {was, was_run, was_frame} <= {motion, run, frame};
        was_armed <= is_allowed;
        may_begin <= was_armed && has_motor;
        must_rest <= stops && (motion != AT_REST) && (in_motion || state == CEASE);
        travelled <= travel && done;
        body_ended <= state == ACT && motion == BODY && idle && body_left == 1;
        has_tail <= tail_left != 0 && !is_last;
        if (begins) is_permitted <= may_begin;
        if (state == IDLE) has_travelled <= 0;
        else if (travel && done) has_travelled <= 1;
    end

    always @* begin
        // Nothing runs that is not armed, and a veto before the start is obeyed.
        if (begins) assert (may_begin && frame == was_frame + 1 && run == was_run);
        if (travel && !begins) assert (is_permitted);
        if (engine_step) assume (travelled); // axis_engine.v
        if (step) assert (is_permitted);
        // A run begins with its first frame, and every other frame follows a body that has ended.
        if (begins && was == WAITING) assert (frame == 1);
        if (begins && was == BODY) assert (body_ended);
        assert (!(motion == BODY && was == AT_REST));
        // A tail follows if nothing is armed when a body has ended, and never returns to a body.
        if (body_ended && !may_begin) assert (motion == (has_tail ? TAIL : AT_REST));
        if (was == TAIL) assert (motion == TAIL || motion == AT_REST);
        if (motion == TAIL && was != TAIL) assert (body_ended);
        // STOP, a disabled motor and a closed input of STOP_INPUTS end the run, and nothing moves at rest.
        if (must_rest) assert (motion == AT_REST);
        if (travel || accelerate) assert (motion == BODY || motion == TAIL);
        // No step goes into a closed limit switch, and a tick makes one step at most.
        if (step && forward) assert ((closed & limit_max) == 0);
        if (step && !forward) assert ((closed & limit_min) == 0);
        if (travel) assert (!has_travelled);
        // A run does not change in motion.
        if (was == BODY || was == TAIL) assert (run == was_run);
`ifdef REACHABLE
        assert (motion != TAIL); // must fail: a tail is reached
`endif
    end
