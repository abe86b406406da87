#include "tests/unit/wire/random_messages.hpp"

namespace lockstep {

Frame RandomMessages::frame() {
    Frame frame{.term = term(),
                .epoch = bits(),
                .number = bits(),
                .start = {far()},
                .ticks = {between(1, INT32_MAX)},
                .last = coin(),
                .axes = std::vector<AxisTrack>(1 + index(kMaxAxes))};
    for (AxisTrack& axis : frame.axes) {
        axis.from = position();
        for (std::uint32_t n = index(kMaxBodyPieces + 1); n > 0; --n) { (void)axis.body.push_back(piece()); }
        for (std::uint32_t n = index(kMaxTailPieces + 1); n > 0; --n) { (void)axis.tail.push_back(piece()); }
    }
    frame.touch.opens = coin();
    for (std::uint32_t n = index(kMaxTouchInputs + 1); n > 0; --n) {
        frame.touch.any_of.append({MotorIndex{index(kMaxAxes)}, static_cast<std::uint8_t>(index(kMostInputs))});
    }
    frame.touch.ceases = !frame.touch.any_of.empty() && coin();
    return frame;
}

AxisState RandomMessages::axis_state() {
    return {.identity = bits(),
            .axis = index(kMaxAxes),
            .stamp = far(),
            .epoch = bits(),
            .held = bits(),
            .veto = maybe(bits()),
            .ran = bits(),
            .at_rest = coin(),
            .homed = coin(),
            .phase = static_cast<AxisPhase>(index(7)),
            .fault = fault(),
            .position = position(),
            .velocity = {rate()},
            .tick = {far()},
            .following_error_steps = far(),
            .corrected_steps = static_cast<std::uint32_t>(bits()),
            .play_steps = far() % 1000,
            .command_done = bits() >> 2,
            .command_fault = fault(),
            .config_hash = bits(),
            .refused_frames = bits(),
            .clock_error = {between(0, std::int64_t{1} << 62)},
            .term = term(),
            .hears_owner = coin(),
            .unproved = fault(),
            .switches = {coin(), coin(), coin()},
            .homing = static_cast<HomingStage>(index(6)),
            .inputs = static_cast<std::uint32_t>(bits()),
            .outputs = static_cast<std::uint16_t>(bits()),
            .pulses_left = static_cast<std::uint32_t>(bits()),
            .analog = analog_levels(),
            .touch = maybe(EpochTouch{bits(), {far()}, static_cast<std::uint8_t>(index(kMostInputs))}),
            .ceased = coin()};
}

AxisHealth RandomMessages::axis_health() {
    return {.identity = bits(),
            .axis = index(kMaxAxes),
            .tick = {far()},
            .step_lateness = extremes(),
            .step_interval = extremes(),
            .setpoint_slack = extremes(),
            .least_free_segments = static_cast<std::uint32_t>(bits()),
            .least_free_captures = static_cast<std::uint32_t>(bits()),
            .loop = {{far()}, {far()}, {far()}},
            .setpoint_age = maybe(Ticks{far()}),
            .clock_error = {far()},
            .refused = {bits(), bits(), bits(), bits(), bits(), bits(), bits()}};
}

AxisCommand RandomMessages::axis_command() {
    return {.term = term(),
            .sequence = bits() >> 2,
            .axis = index(kMaxAxes),
            .kind = static_cast<AxisCommandKind>(index(9)),
            .target_steps = far(),
            .ticks = maybe(Ticks{between(1, INT32_MAX)}),
            .speed_mm_s = static_cast<double>(between(0, 1'000'000)) / 7,
            .until = {far()}};
}

ClockRequest RandomMessages::clock_request() {
    return {.axis = index(kMaxAxes), .identity = bits(), .sequence = bits(), .sent = {far()}};
}

ClockReply RandomMessages::clock_reply() {
    return {.request = clock_request(), .received = {far()}, .answered = {far()}};
}

StaticVector<FrameRest, kMaxRests> RandomMessages::rests() {
    StaticVector<FrameRest, kMaxRests> rests;
    for (std::size_t count = index(kMaxRests + 1); count > 0; --count) {
        const Int128 along = Int128{far()} * kOneStep + Int128{bits()};
        rests.append({bits(), {static_cast<std::uint32_t>(bits()), {along}}, coin(), bits()});
    }
    return rests;
}

ProgramDevices RandomMessages::devices() {
    return {.spindle = static_cast<SpindleDirection>(index(3)),
            .spindle_rpm = static_cast<double>(between(0, 1'000'000)) / 7,
            .mist = coin(),
            .flood = coin(),
            .tool = maybe(static_cast<std::int32_t>(between(1, INT32_MAX))),
            .outputs = bits()};
}

PublishedEvent RandomMessages::event() {
    return {.term = term(),
            .sequence = bits(),
            .job = bits(),
            .epoch = bits(),
            .tick = {far()},
            .at_rest = coin(),
            .is_of_program = coin(),
            .block = static_cast<std::uint32_t>(bits()),
            .line = maybe(static_cast<std::int32_t>(between(1, INT32_MAX))),
            .event = {.kind = static_cast<ProgramEvent::Kind>(index(kEventWords.size())),
                      .index = static_cast<std::int32_t>(between(0, kMaxEventIndex)),
                      .value = static_cast<double>(between(-1'000'000, 1'000'000)) / 7}};
}

MachineState RandomMessages::machine_state() {
    const FaultCode machine_fault = fault();
    return {.term = term(),
            .stamp = far(),
            .tick = {far()},
            .phase = static_cast<MachinePhase>(index(10)),
            .fault = machine_fault,
            .fault_motor = is_of_an_axis(machine_fault) ? std::optional(MotorIndex{index(kMaxAxes)}) : std::nullopt,
            .epoch = bits(),
            .sent = bits(),
            .veto = maybe(bits()),
            .job = bits(),
            .outcome = maybe(static_cast<JobOutcome>(index(3))),
            .job_begun = term(),
            .line = maybe(static_cast<std::int32_t>(between(1, INT32_MAX))),
            .job_fault = fault(),
            .lacks_blocks = coin(),
            .progress = static_cast<double>(between(0, 1000)) / 1000,
            .remaining_s = static_cast<double>(between(0, 1'000'000)) / 7,
            .overrides = {static_cast<int>(between(10, 200)), static_cast<int>(between(10, 200))},
            .motors_present = MotorSet::of_bits(bits()),
            .config_hash = bits(),
            .devices = devices(),
            .lease = maybe(HeldLease{writer(), {far()}}),
            .pause = maybe(pause()),
            .probe = maybe(probe()),
            .job_kind = coin() ? JobKind::Run : JobKind::Move,
            .program = maybe(bits()),
            .leg_from = places(),
            .events_from = static_cast<std::uint32_t>(bits()),
            .rests = rests(),
            .homing = maybe(HomedByTouch{index(kMaxAxes), static_cast<HomingStage>(index(6))}),
            .published = {.job_events = bits(), .program_parts = bits()},
            .lost_records = bits(),
            .process = {.reopened = bits(), .lost_log_lines = bits()}};
}

ProbeResult RandomMessages::probe() {
    ProbeResult probe{
        .job = bits(), .input = maybe(static_cast<std::uint32_t>(bits())), .tick = {far()}, .places_mm = {}};
    const auto axes = index(kMaxAxes + 1);
    while (probe.places_mm.size() < axes) {
        probe.places_mm.append(static_cast<double>(between(-1'000'000, 1'000'000)) / 7);
    }
    return probe;
}

StaticVector<std::int64_t, kMaxAxes> RandomMessages::places() {
    StaticVector<std::int64_t, kMaxAxes> places;
    for (std::size_t i = index(kMaxAxes + 1); i > 0; --i) { places.append(far()); }
    return places;
}

MachinePause RandomMessages::pause() {
    MachinePause pause{.why = {.reason = static_cast<PauseReason>(index(5)),
                               .tool = static_cast<std::int32_t>(between(0, kMaxTool)),
                               .text = std::string(index(kMaxPauseText + 1), 'p')},
                       .place = places()};
    pause.wait_left_s = static_cast<double>(index(1000));
    return pause;
}

LeaseHolder RandomMessages::writer() {
    return {.id = bits(),
            .name = std::string(index(kMaxWriterBytes + 1), 'n'),
            .host = std::string(index(kMaxWriterBytes + 1), 'h')};
}

std::vector<JogAxis> RandomMessages::jogs() {
    std::vector<JogAxis> jogs(index(64 + 1));
    for (JogAxis& jog : jogs) {
        jog = {AxisIndex{index(kMaxAxes)}, static_cast<double>(between(-1'000'000, 1'000'000)) / 7,
               maybe(static_cast<double>(between(1, 1'000'000)) / 7)};
    }
    return jogs;
}

Command RandomMessages::command() {
    return {.client = bits(),
            .sequence = bits(),
            .kind = static_cast<CommandKind>(index(13)),
            .axes = AxisSet::of_bits(bits()),
            .program = bits(),
            .ticks = maybe(Ticks{between(1, INT32_MAX)}),
            .feed_percent = maybe(static_cast<int>(between(1, UINT16_MAX))),
            .rapid_percent = maybe(static_cast<int>(between(1, UINT16_MAX))),
            .jogs = jogs(),
            .writer = writer(),
            .takes_over = coin()};
}

ProgramChunk RandomMessages::chunk() {
    const std::uint32_t count = 1 + index(4096);
    ProgramChunk chunk{.client = bits(),
                       .sequence = bits(),
                       .program = bits(),
                       .index = index(count),
                       .count = maybe(count),
                       .share = maybe(static_cast<double>(1 + index(1000)) / 1000)};
    chunk.writer = bits();
    chunk.bytes.resize(index(32768 + 1));
    for (auto& byte : chunk.bytes) { byte = static_cast<std::uint8_t>(bits()); }
    return chunk;
}

MachineValues RandomMessages::machine_values() {
    MachineValues values{.term = term(), .revision = bits(), .on_disk = coin(), .bytes = {}};
    values.bytes.resize(index(32768 + 1));
    for (auto& byte : values.bytes) { byte = static_cast<std::uint8_t>(bits()); }
    return values;
}

Reply RandomMessages::reply() {
    return {.client = bits(),
            .sequence = bits(),
            .status = static_cast<ReplyStatus>(index(2)),
            .fault = fault(),
            .job = bits(),
            .text = std::string(index(1024), 'x')};
}

}  // namespace lockstep
