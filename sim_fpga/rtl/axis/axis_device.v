// The device of one motor behind its register map (sim_fpga/REGISTERS.md). It makes every step in the same tick as
// sim_fpga/device.hpp, and shows the same registers after each tick.
//
// The map is memory: a write takes one clock, and a word that is read comes two clocks after its address. Inputs, ticks
// and accesses belong to one clock. There is no encoder, and there are no pulses at places.
//
// Pieces are run from the segment ring, which saves a second memory. So FEATURES has FRAMES_STAY.
module axis_device #(
    parameter [63:0] TICK_NS = 1000,
    parameter TIME_UNIT_PS = 20833, // the clock's period
    parameter TIME_BITS = 16,   // of a pulse time in TIME_UNIT_PS
    parameter LEAST_STEP_TICKS = 2,
    parameter INPUTS = 8,
    parameter DIGITAL = 8,
    parameter ANALOG = 2,
    parameter OUTPUT_BITS = 5,  // 2 to the power of it is OUTPUT_ENTRIES
    parameter SEGMENT_BITS = 8, // 2 to the power of it is SEGMENT_ENTRIES
    parameter CAPTURE_BITS = 8, // and CAPTURE_ENTRIES
    parameter EVENT_BITS = 4,   // and EVENT_ENTRIES
    parameter [63:0] LEAD_TICKS = 0,
    parameter [63:0] PIN_TICKS = 0,
    parameter SETTLE_CLOCKS = 8 // axis_sequencer.v
) (
    input clk,
    input tick,                 // for one clock: another tick
    output busy,                // it is being executed
    input [63:0] first_tick,    // TICK and POWER_UP at power-up
    input [63:0] power_up,
    // The host.
    input write,
    input [19:3] write_address,
    input [63:0] write_data,
    input [19:3] read_address,
    output reg [63:0] read_data,
    input hold,                 // the device's words stay as they are
    // The motor.
    input [INPUTS-1:0] pins,
    output step,                // for one clock
    output forward,
    output enabled,
    // How the pins show that, as in the setup.
    output [TIME_BITS-1:0] step_width,
    output [TIME_BITS-1:0] direction_setup,
    output [TIME_BITS-1:0] direction_hold,
    output [2:0] inverted,
    // The outputs.
    output [15:0] digital,      // output n is bit n, 1 while it is on
    output [15:0] outputs_inverted,
    output [ANALOG*TIME_BITS-1:0] pwm_periods,
    output [127:0] analog       // 16 bits each, in 2^-15 of full scale
);
    // verilator lint_off UNUSED
    `include "registers.vh"
    // verilator lint_on UNUSED

    // The constants of the map, each at its offset.
    function [2047:0] placed(input [19:0] offset, input [63:0] value);
        begin
            placed = 0;
            placed[8*offset +: 64] = value;
        end
    endfunction
    localparam [2047:0] CONSTANTS =
        placed(LOCKSTEP_MAGIC, LOCKSTEP_MAGIC_VALUE) |
        placed(LOCKSTEP_VERSION, LOCKSTEP_VERSION_VALUE) |
        placed(LOCKSTEP_MAP_CHECKSUM, LOCKSTEP_MAP_CHECKSUM_VALUE) |
        placed(LOCKSTEP_TICK_NS, TICK_NS) |
        placed(LOCKSTEP_SEGMENT_ENTRIES, 64'd1 << SEGMENT_BITS) |
        placed(LOCKSTEP_CAPTURE_ENTRIES, 64'd1 << CAPTURE_BITS) |
        placed(LOCKSTEP_LEAST_STEP_TICKS, LEAST_STEP_TICKS) |
        placed(LOCKSTEP_TIME_UNIT_PS, TIME_UNIT_PS) |
        placed(LOCKSTEP_LONGEST_TIME, (64'd1 << TIME_BITS) - 1'b1) |
        placed(LOCKSTEP_LONGEST_PWM_PERIOD, (64'd1 << TIME_BITS) - 1'b1) |
        placed(LOCKSTEP_LONGEST_PIECE_TICKS, 64'hffffffff) |
        placed(LOCKSTEP_LEAD_TICKS, LEAD_TICKS) |
        placed(LOCKSTEP_PIN_TICKS, PIN_TICKS) |
        placed(LOCKSTEP_INPUT_CHANNELS, INPUTS) |
        placed(LOCKSTEP_DIGITAL_CHANNELS, DIGITAL) |
        placed(LOCKSTEP_ANALOG_CHANNELS, ANALOG) |
        placed(LOCKSTEP_OUTPUT_ENTRIES, 64'd1 << OUTPUT_BITS) |
        placed(LOCKSTEP_EVENT_ENTRIES, 64'd1 << EVENT_BITS) |
        placed(LOCKSTEP_FEATURES, 64'd1 << LOCKSTEP_FEATURES_ENABLE_BIT | 64'd1 << LOCKSTEP_FEATURES_FRAMES_STAY_BIT);

    wire [63:0] run_request, armed, veto, stop;
    wire [SEGMENT_BITS:0] segment_head;
    wire [OUTPUT_BITS:0] output_head;
    wire [CAPTURE_BITS:0] capture_tail;
    wire [EVENT_BITS:0] event_tail;
    wire [63:0] host_word;
    wire [32:0] trigger;
    wire enable, start_setup, setup_busy, beats, look_at_host, asks_direct, direct_outputs, asks_setup;
    axis_host_words #(.CAPTURE_BITS(CAPTURE_BITS), .EVENT_BITS(EVENT_BITS), .SEGMENT_BITS(SEGMENT_BITS),
        .OUTPUT_BITS(OUTPUT_BITS), .CONSTANTS(CONSTANTS)) host_words (.clk(clk), .write(write),
        .write_address(write_address), .write_data(write_data),
        .read_address({read_address[13:12] == 0, read_address[13], read_address[8:3]}), .read_word(host_word),
        .run_request(run_request), .trigger(trigger), .armed(armed), .veto(veto), .stop(stop), .enable(enable),
        .segment_head(segment_head), .capture_tail(capture_tail), .event_tail(event_tail), .output_head(output_head),
        .beats(beats), .take_beat(look_at_host), .asks_direct(asks_direct), .take_direct(direct_outputs),
        .asks_setup(asks_setup), .take_setup(start_setup));

    // What the device reads of it.
    wire reads_setup, asks_request, reads_direct, reads_entry;
    wire [6:0] setup_address, direct_address;
    wire [OUTPUT_BITS+1:0] entry_address, output_scan_address;
    wire [63:0] device_word;
    axis_host_memory #(.ENTRY_BITS(OUTPUT_BITS)) host_memory (.clk(clk), .write(write), .write_address(write_address),
        .write_data(write_data), .reads_word(reads_setup || reads_direct || asks_request),
        .word_address(reads_direct ? direct_address : setup_address), .reads_entry(reads_entry),
        .entry_address(entry_address), .scan_address(output_scan_address), .word(device_word));

    wire [39:0] at_cut, at_silence;
    wire setup_taken, setup_refused, invert_inputs, set_debounce, disables_at_silence;
    wire [31:0] enable_ticks, debounce_ticks, silence_ticks;
    wire [INPUTS-1:0] inputs_inverted, next_inputs_inverted, limit_min, limit_max, home, stop_inputs;
    wire [4:0] debounce_input;
    axis_setup #(.INPUTS(INPUTS), .DIGITAL(DIGITAL), .ANALOG(ANALOG), .TIME_BITS(TIME_BITS)) setup_words (.clk(clk),
        .start(start_setup), .busy(setup_busy), .taken(setup_taken), .refused(setup_refused),
        .reads(reads_setup), .address(setup_address),
        .word(device_word), .step_width(step_width), .direction_setup(direction_setup),
        .direction_hold(direction_hold), .enable_ticks(enable_ticks),
        .inverted(inverted), .inputs_inverted(inputs_inverted), .invert_inputs(invert_inputs),
        .next_inputs_inverted(next_inputs_inverted), .limit_min(limit_min), .limit_max(limit_max), .home(home),
        .stop(stop_inputs), .set_debounce(set_debounce), .debounce_input(debounce_input),
        .debounce_ticks(debounce_ticks), .pwm_periods(pwm_periods), .outputs_inverted(outputs_inverted),
        .at_cut(at_cut), .at_silence(at_silence),
        .disables_at_silence(disables_at_silence), .silence_ticks(silence_ticks));

    wire [63:0] run, frame;
    wire [SEGMENT_BITS:0] segment_tail;
    wire ticks, look, inputs_busy, judge_host, falls_silent, is_host_silent;
    wire powers_up, advance, accelerate, travel, check, adder_done;
    wire [INPUTS-1:0] closed;
    wire input_changes, changed_closed, events_busy;
    wire [4:0] changed_input;
    axis_inputs #(.INPUTS(INPUTS)) inputs (.clk(clk), .pins(pins), .inverted(inputs_inverted), .invert(invert_inputs),
        .next_inverted(next_inputs_inverted), .set_debounce(set_debounce), .debounce_input(debounce_input),
        .debounce_ticks(debounce_ticks), .tick(ticks), .look(look), .busy(inputs_busy), .closed(closed),
        .changes(input_changes), .changed_input(changed_input), .changed_closed(changed_closed),
        .wait_for_event(events_busy));
    // Inputs and outputs never change in the same clock, because one is looked at after the other.
    wire output_changes, is_analog;
    wire [4:0] changed_output;
    wire gives_value, keeps_value, gives_slope, asks_slope;
    wire [7:0] has_slope, is_zero;
    axis_host_watch host_watch (.clk(clk), .begins(setup_taken), .look(look_at_host), .beats(beats), .tick(ticks),
        .judge(judge_host), .patience(silence_ticks), .falls_silent(falls_silent), .is_silent(is_host_silent));

    wire load, drop_own, drop_others, take, frame_settled, frame_valid, frame_good, frame_is_last, frame_is_of_run;
    wire [SEGMENT_BITS-1:0] piece;
    wire [1:0] entry_field;
    wire [SEGMENT_BITS+1:0] scan_address;
    wire [SEGMENT_BITS:0] frame_at;
    wire [63:0] entry_word;
    wire [31:0] frame_number;
    wire [15:0] frame_body_pieces, frame_tail_pieces;
    wire is_segment_write = write && write_address[19:17] == LOCKSTEP_SEGMENT_RING[19:17];
    axis_ring_memory #(.ENTRY_BITS(SEGMENT_BITS)) segments (.clk(clk), .write(is_segment_write),
        .write_address(write_address[SEGMENT_BITS+4:3]), .write_data(write_data),
        .read_address(load || check ? {load ? piece : frame_at[SEGMENT_BITS-1:0], entry_field} : scan_address),
        .word(entry_word));
    axis_frame_scanner #(.ENTRY_BITS(SEGMENT_BITS)) scanner (.clk(clk), .head(segment_head), .run(run[23:0]),
        .drop_own(drop_own), .drop_others(drop_others), .take(take), .pause(load || check), .address(scan_address),
        .word(entry_word), .settled(frame_settled), .valid(frame_valid), .good(frame_good), .taken(frame_at),
        .is_last(frame_is_last), .is_of_run(frame_is_of_run), .number(frame_number),
        .body_pieces(frame_body_pieces), .tail_pieces(frame_tail_pieces));

    wire due_outputs, silence_outputs, end_outputs, is_cut, begins_body, begins_tail, rests, in_motion;
    wire outputs_busy, outputs_settled, outputs_well;
    wire [OUTPUT_BITS:0] output_tail, first_output, behind_outputs;
    wire changes_run;
    axis_output_ring #(.ENTRY_BITS(OUTPUT_BITS), .DIGITAL(DIGITAL), .ANALOG(ANALOG)) output_ring (.clk(clk),
        .head(output_head), .run(run[23:0]), .frame(frame[31:0]), .restart(changes_run), .rests(rests),
        .in_motion(in_motion), .drop_own(drop_own), .take(begins_body), .settled(outputs_settled),
        .is_well(outputs_well),
        .tail(output_tail), .first(first_output), .behind(behind_outputs),
        .pause(reads_setup || reads_direct || asks_request || reads_entry),
        .address(output_scan_address), .word(device_word));
    axis_outputs #(.ENTRY_BITS(OUTPUT_BITS), .DIGITAL(DIGITAL), .ANALOG(ANALOG)) outputs (.clk(clk),
        .direct(direct_outputs), .due(due_outputs), .begin_body(begins_body), .is_well(outputs_well),
        .begin_tail(begins_tail), .end_run(end_outputs), .is_cut(is_cut), .silence(silence_outputs), .tick(ticks),
        .busy(outputs_busy), .is_host_silent(is_host_silent), .at_cut(at_cut), .at_silence(at_silence),
        .asks_direct(asks_direct), .reads_word(reads_direct), .word_address(direct_address),
        .reads_entry(reads_entry), .entry_address(entry_address), .word(device_word), .run(run[23:0]),
        .frame(frame[31:0]), .first(first_output), .behind(behind_outputs), .put(output_changes),
        .is_analog(is_analog), .channel(changed_output), .gives_value(gives_value), .keeps_value(keeps_value),
        .gives_slope(gives_slope), .asks_slope(asks_slope), .has_slope(has_slope), .is_zero(is_zero),
        .events_busy(events_busy), .levels(digital));

    wire halt, rebase, rest, idle, overflow, engine_step, engine_backward;
    wire is_past, is_now, is_place, is_same_phase, is_rest_phase;
    wire capture_full, triggered, publish, publish_busy;
    wire [16:0] status;
    axis_sequencer #(.INPUTS(INPUTS), .ENTRY_BITS(SEGMENT_BITS), .SETTLE_CLOCKS(SETTLE_CLOCKS)) sequencer (.clk(clk),
        .tick(tick), .busy(busy), .ticks(ticks), .run_request(run_request),
        .trigger_request(trigger), .armed(armed), .veto(veto), .stop(stop), .enable(enable),
        .setup_is_new(asks_setup), .start_setup(start_setup), .setup_busy(setup_busy || events_busy),
        .setup_taken(setup_taken),
        .setup_refused(setup_refused), .enable_ticks(enable_ticks), .limit_min(limit_min), .limit_max(limit_max),
        .home(home), .stop_inputs(stop_inputs), .disables_at_silence(disables_at_silence), .look(look),
        .inputs_busy(inputs_busy), .closed(closed), .look_at_host(look_at_host), .judge_host(judge_host),
        .falls_silent(falls_silent), .is_host_silent(is_host_silent), .direct_outputs(direct_outputs),
        .due_outputs(due_outputs), .silence_outputs(silence_outputs), .end_outputs(end_outputs), .is_cut(is_cut),
        .begins_body(begins_body), .begins_tail(begins_tail), .changes_run(changes_run), .outputs_busy(outputs_busy),
        .outputs_settled(outputs_settled), .outputs_well(outputs_well), .at_rest(rests), .in_motion(in_motion),
        .drop_own(drop_own), .drop_others(drop_others), .take(take),
        .frame_settled(frame_settled), .frame_valid(frame_valid), .frame_good(frame_good), .frame_at(frame_at),
        .frame_is_last(frame_is_last), .frame_is_of_run(frame_is_of_run), .frame_number(frame_number),
        .frame_body_pieces(frame_body_pieces),
        .frame_tail_pieces(frame_tail_pieces), .power_up(powers_up), .load(load), .piece(piece), .advance(advance),
        .accelerate(accelerate), .travel(travel), .check(check), .done(adder_done), .is_past(is_past),
        .is_now(is_now), .is_place(is_place), .is_same_phase(is_same_phase), .is_rest_phase(is_rest_phase),
        .halt(halt), .rebase(rebase), .rest(rest), .idle(idle), .overflow(overflow),
        .engine_step(engine_step), .engine_backward(engine_backward), .step(step), .forward(forward),
        .capture_full(capture_full), .publish(publish), .publish_busy(publish_busy), .status(status),
        .run(run), .frame(frame), .triggered(triggered), .segment_tail(segment_tail),
        .enabled(enabled));

    wire [63:0] shown_word, captured_step;
    wire is_published;
    wire is_event_read = read_address[19:16] == LOCKSTEP_EVENT_RING[19:16];
    axis_adder #(.CAPTURE_BITS(CAPTURE_BITS), .EVENT_BITS(EVENT_BITS), .SEGMENT_BITS(SEGMENT_BITS),
        .OUTPUT_BITS(OUTPUT_BITS), .ANALOG(ANALOG)) adder (.clk(clk), .busy(events_busy),
        .power_up(powers_up), .first_tick(first_tick), .load(load), .entry_field(entry_field),
        .entry_word(entry_word), .advance(advance), .accelerate(accelerate), .travel(travel), .check(check),
        .done(adder_done), .is_past(is_past), .is_now(is_now), .is_place(is_place),
        .is_same_phase(is_same_phase), .is_rest_phase(is_rest_phase),
        .rebase(rebase), .rest(rest), .halt(halt), .idle(idle), .overflow(overflow), .engine_step(engine_step),
        .backward(engine_backward),
        .step(step), .forward(forward), .capture_tail(capture_tail), .capture_full(capture_full),
        .triggered(triggered), .setup_taken(setup_taken), .asks_request(asks_request),
        .host_word(device_word), .put(input_changes || output_changes),
        .kind(!output_changes ? 2'd0 : is_analog ? 2'd2 : 2'd1),
        .channel(!output_changes ? changed_input : is_analog ? changed_output : 5'd0),
        .levels(!output_changes ? {15'd0, changed_closed} : is_analog ? 16'd0 : digital), .gives_value(gives_value),
        .keeps_value(keeps_value), .gives_slope(gives_slope), .asks_slope(asks_slope), .has_slope(has_slope),
        .is_zero(is_zero), .tick(ticks), .analog(analog), .event_tail(event_tail), .publish(publish), .hold(hold),
        .publish_busy(publish_busy),
        .is_published(is_published), .status(status), .run(run), .frame(frame), .segment_tail(segment_tail),
        .inputs({{(32 - INPUTS){1'b0}}, closed}), .outputs(digital), .output_tail(output_tail),
        .reads_event(is_event_read), .read_event(read_address[EVENT_BITS+4:3]), .read_word_number(read_address[7:3]),
        .read_word(shown_word), .read_entry(read_address[CAPTURE_BITS+2:3]), .read_step(captured_step));

    // What the host reads.
    reg [19:3] address;         // a clock later, with the memories' words
    wire is_event = address[19:16] == LOCKSTEP_EVENT_RING[19:16];
    wire is_device_word = address[19:9] == 0 && address[8];
    wire is_power_up = {address, 3'd0} == LOCKSTEP_POWER_UP;
    always @(posedge clk) begin
        address <= read_address;
        read_data <= !is_published ? 64'd0 : address[19] ? captured_step : is_event || is_device_word ? shown_word :
            is_power_up ? power_up : host_word;
    end
endmodule
