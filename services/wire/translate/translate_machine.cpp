#include <span>

#include "core/if_positive.hpp"
#include "services/wire/translate/checks.hpp"
#include "services/wire/translate/translate.hpp"
#include "services/wire/translate/writer_text.hpp"

namespace lockstep {

static_assert(lockstep_wire_MACHINE_JOGGING == static_cast<int>(MachinePhase::Jogging));
static_assert(lockstep_wire_JOB_FAILED == static_cast<int>(JobOutcome::Failed));
static_assert(lockstep_wire_PAUSE_INPUT_TIMEOUT == static_cast<int>(PauseReason::InputTimeout));
static_assert(lockstep_wire_MAX_PAUSE_BYTES == kMaxPauseText && lockstep_wire_MAX_PLACES == kMaxAxes);
static_assert(lockstep_wire_MAX_RESTS == kMaxRests);
static_assert(lockstep_wire_MAX_HOLDER_BYTES == kMaxWriterBytes);
static_assert(lockstep_wire_SPINDLE_REVERSE == static_cast<int>(SpindleDirection::Reverse));

namespace {

lockstep_wire_FrameRest rest_to_wire(const FrameRest& rest) {
    return {.frame = rest.frame,
            .block = rest.place.block,
            .along_high = static_cast<std::int64_t>(rest.place.along.raw >> 64),
            .along_low = static_cast<std::uint64_t>(rest.place.along.raw),
            .last = rest.last,
            .digest = rest.digest};
}

FrameRest rest_from_wire(const lockstep_wire_FrameRest& wire) {
    const Int128 along = Int128{wire.along_high} * kOneStep + Int128{wire.along_low};
    return {wire.frame, {wire.block, {along}}, wire.last, wire.digest};
}

std::span<const std::int64_t> places_of(const dds_sequence_long_long& wire) { return {wire._buffer, wire._length}; }

void places_to_wire(const StaticVector<std::int64_t, kMaxAxes>& places, std::vector<std::int64_t>& storage,
                    dds_sequence_long_long& wire) {
    storage.assign(places.begin(), places.end());
    const auto size = static_cast<std::uint32_t>(storage.size());
    wire = {._maximum = size, ._length = size, ._buffer = storage.data(), ._release = false};
}

void pause_to_wire(const MachinePause& pause, MachineStateMessage& message) {
    message.pause_reason = static_cast<lockstep_wire_PauseReason>(pause.why.reason);
    message.pause_tool = pause.why.tool;
    message.pause_wait_left_s = pause.wait_left_s;
    write_text(pause.why.text, message.pause_text);
    places_to_wire(pause.place, message.place_storage, message.pause_place);
}

void pause_from_wire(const lockstep_wire_MachineState& wire, std::optional<MachinePause>& into, Checks& check) {
    const auto reason = check.choice("pause_reason", wire.pause_reason, PauseReason::InputTimeout);
    const std::string_view text = read_text("pause_text", wire.pause_text, check);
    if (!check.passed()) { return; }
    if (!wire.has_pause) { return into.reset(); }
    MachinePause& pause = into ? *into : into.emplace();
    pause.why.reason = reason;
    pause.why.tool = wire.pause_tool;
    pause.why.text = text;
    pause.wait_left_s = wire.pause_wait_left_s;
    pause.place.clear();
    for (const std::int64_t steps : places_of(wire.pause_place)) { pause.place.append(steps); }
}

auto analog_from_wire(const lockstep_wire_MachineState& wire, Checks& check) {
    auto analog = ProgramDevices{}.analog;
    check.within<std::size_t>("the number of analog_outputs", wire.analog_outputs._length, 0, analog.size());
    for (std::size_t k = 0; k < analog.size() && k < wire.analog_outputs._length; ++k) {
        analog[k] = wire.analog_outputs._buffer[k];
        check.finite("analog_outputs", analog[k]);
    }
    return analog;
}

/// Those behind the last one that is not 0 are left out.
void analog_to_wire(const ProgramDevices& devices, MachineStateMessage& message) {
    message.analog_storage.assign(devices.analog.begin(), devices.analog.end());
    while (!message.analog_storage.empty() && message.analog_storage.back() == 0) { message.analog_storage.pop_back(); }
    const auto size = static_cast<std::uint32_t>(message.analog_storage.size());
    message.analog_outputs = {
        ._maximum = size, ._length = size, ._buffer = message.analog_storage.data(), ._release = false};
}

void probe_to_wire(const ProbeResult& probe, MachineStateMessage& message) {
    message.probe_job = probe.job;
    message.probe_touched = probe.touched();
    message.probe_input = probe.input.value_or(0);
    message.probe_tick = probe.tick.value;
    message.probe_storage.assign(probe.places_mm.begin(), probe.places_mm.end());
    const auto size = static_cast<std::uint32_t>(message.probe_storage.size());
    message.probe_places_mm = {
        ._maximum = size, ._length = size, ._buffer = message.probe_storage.data(), ._release = false};
}

std::optional<ProbeResult> probe_from_wire(const lockstep_wire_MachineState& wire, Checks& check) {
    check.within<std::size_t>("the number of probe_places_mm", wire.probe_places_mm._length, 0, kMaxAxes);
    check.far("probe_tick", wire.probe_tick);
    if (!wire.has_probe || !check.passed()) { return std::nullopt; }
    ProbeResult probe{.job = wire.probe_job,
                      .input = wire.probe_touched ? std::optional(wire.probe_input) : std::nullopt,
                      .tick = {wire.probe_tick},
                      .places_mm = {}};
    for (const double mm : std::span(wire.probe_places_mm._buffer, wire.probe_places_mm._length)) {
        check.finite("probe_places_mm", mm);
        probe.places_mm.append(mm);
    }
    return probe;
}

PulseOrder pulses_from_wire(const lockstep_wire_MachineState& wire, Checks& check) {
    check.finite("pulse_first_mm", wire.pulse_first_mm);
    check.finite("pulse_spacing_mm", wire.pulse_spacing_mm);
    check.within<std::uint32_t>("pulse_count", wire.pulse_count, 0, kMaxEventIndex);
    check.within<std::uint32_t>("pulses_left", wire.pulses_left, 0, wire.pulse_count);
    return {.output = wire.pulse_output,
            .first_mm = wire.pulse_first_mm,
            .spacing_mm = wire.pulse_spacing_mm,
            .count = wire.pulse_count,
            .left = wire.pulses_left};
}

ProgramDevices devices_from_wire(const lockstep_wire_MachineState& wire, Checks& check) {
    check.finite("spindle_rpm", wire.spindle_rpm);
    return {.spindle = check.choice("spindle", wire.spindle, SpindleDirection::Reverse),
            .spindle_rpm = wire.spindle_rpm,
            .mist = wire.mist,
            .flood = wire.flood,
            .tool = if_positive(wire.tool),
            .outputs = wire.outputs,
            .analog = analog_from_wire(wire, check),
            .pulses = pulses_from_wire(wire, check)};
}

std::optional<HomedByTouch> homing_from_wire(const lockstep_wire_MachineState& wire, Checks& check) {
    check.within<std::size_t>("homing_axis", wire.homing_axis, 0, kMaxAxes - 1);
    check.within("homing_stage", wire.homing_stage, std::uint16_t{0}, static_cast<std::uint16_t>(HomingStage::Release));
    if (!wire.has_homing) { return std::nullopt; }
    return HomedByTouch{wire.homing_axis, static_cast<HomingStage>(wire.homing_stage)};
}

void check_numbers(const lockstep_wire_MachineState& wire, Checks& check) {
    check.far("stamp", wire.stamp);
    check.far("tick", wire.tick);
    check.within<std::size_t>("fault_axis", wire.fault_axis, 0, kMaxAxes - 1);
    check.within("progress", wire.progress, 0.0, 1.0);
    check.finite("remaining_s", wire.remaining_s);
    check.within<int>("feed_percent", wire.feed_percent, Overrides::kLeast, Overrides::kMost);
    check.within<int>("rapid_percent", wire.rapid_percent, Overrides::kLeast, Overrides::kMost);
    check.far("writer_since", wire.writer_since);
    check.within<std::int32_t>("pause_tool", wire.pause_tool, 0, kMaxTool);
    check.finite("pause_wait_left_s", wire.pause_wait_left_s);
    check.within<std::size_t>("the number of places", wire.pause_place._length, 0, kMaxAxes);
    check.within<std::size_t>("the number of places where a leg began", wire.leg_from._length, 0, kMaxAxes);
    check.within<std::size_t>("the number of rests", wire.rests._length, 0, lockstep_wire_MAX_RESTS);
    if (!check.passed()) { return; }
    for (const auto& rest : std::span(wire.rests._buffer, wire.rests._length)) {
        check.far("a rest's place", rest.along_high);
    }
    for (const std::int64_t steps : places_of(wire.pause_place)) { check.far("a pause's place", steps); }
    for (const std::int64_t steps : places_of(wire.leg_from)) { check.far("the place where a leg began", steps); }
}

}  // namespace

MachineStateMessage to_wire(const MachineState& state) {
    MachineStateMessage message;
    to_wire(state, message);
    return message;
}

void to_wire(const MachineState& state, MachineStateMessage& message) {
    lockstep_wire_MachineState& wire = message;
    wire = {.term = state.term.number,
            .coordinator = state.term.coordinator,
            .stamp = state.stamp,
            .tick = state.tick.value,
            .phase = static_cast<lockstep_wire_MachinePhase>(state.phase),
            .fault = static_cast<std::uint16_t>(state.fault),
            .fault_axis = static_cast<std::uint32_t>(state.fault_motor.value_or(MotorIndex{})),
            .epoch = state.epoch,
            .sent = state.sent,
            .has_veto = state.veto.has_value(),
            .veto = state.veto.value_or(0),
            .job = state.job,
            .has_outcome = state.outcome.has_value(),
            .outcome = static_cast<lockstep_wire_JobOutcome>(state.outcome.value_or(JobOutcome::Done)),
            .job_term = state.job_begun.number,
            .job_coordinator = state.job_begun.coordinator,
            .line = state.line.value_or(0),
            .job_fault = static_cast<std::uint16_t>(state.job_fault),
            .lacks_blocks = state.lacks_blocks,
            .progress = state.progress,
            .remaining_s = state.remaining_s,
            .feed_percent = static_cast<std::uint16_t>(state.overrides.feed_percent),
            .rapid_percent = static_cast<std::uint16_t>(state.overrides.rapid_percent),
            .axes_present = state.motors_present.bits(),
            .config_hash = state.config_hash,
            .spindle = static_cast<lockstep_wire_Spindle>(state.devices.spindle),
            .spindle_rpm = state.devices.spindle_rpm,
            .mist = state.devices.mist,
            .flood = state.devices.flood,
            .tool = state.devices.tool.value_or(0),
            .outputs = state.devices.outputs,
            .analog_outputs = {},
            .pulse_output = state.devices.pulses.output,
            .pulse_first_mm = state.devices.pulses.first_mm,
            .pulse_spacing_mm = state.devices.pulses.spacing_mm,
            .pulse_count = state.devices.pulses.count,
            .pulses_left = state.devices.pulses.left,
            .has_devices_after = state.devices_after.has_value(),
            .devices_after = state.devices_after.value_or(0),
            .has_writer = state.lease.has_value(),
            .writer = state.lease ? state.lease->writer.id : 0,
            .writer_name = {},
            .writer_host = {},
            .writer_since = state.lease ? state.lease->since.value : 0,
            .has_pause = state.pause.has_value(),
            .pause_reason = {},
            .pause_tool = 0,
            .pause_text = {},
            .pause_place = {},
            .pause_wait_left_s = 0,
            .is_run = state.job_kind == JobKind::Run,
            .program = state.program.value_or(0),
            .leg_from = {},
            .events_from = state.events_from,
            .rests = {},
            .job_messages = state.published.job_events,
            .program_messages = state.published.program_parts,
            .lost_records = state.lost_records,
            .reopened = state.process.reopened,
            .lost_log_lines = state.process.lost_log_lines,
            .has_probe = state.probe.has_value(),
            .probe_job = 0,
            .probe_touched = false,
            .probe_input = 0,
            .probe_tick = 0,
            .probe_places_mm = {},
            .has_homing = state.homing.has_value(),
            .homing_axis = state.homing.value_or(HomedByTouch{}).axis,
            .homing_stage = static_cast<std::uint16_t>(state.homing.value_or(HomedByTouch{}).stage)};
    analog_to_wire(state.devices, message);
    if (state.probe) { probe_to_wire(*state.probe, message); }
    if (state.lease) {
        write_text(state.lease->writer.name, wire.writer_name);
        write_text(state.lease->writer.host, wire.writer_host);
    }
    if (state.pause) { pause_to_wire(*state.pause, message); }
    message.rest_storage.clear();
    for (const FrameRest& rest : state.rests) { message.rest_storage.push_back(rest_to_wire(rest)); }
    const auto size = static_cast<std::uint32_t>(message.rest_storage.size());
    wire.rests = {._maximum = size, ._length = size, ._buffer = message.rest_storage.data(), ._release = false};
    places_to_wire(state.leg_from, message.leg_storage, wire.leg_from);
}

FromWire<MachineState> from_wire(const lockstep_wire_MachineState& wire) {
    MachineState state;
    if (auto read = from_wire(wire, state); !read) { return std::unexpected(std::move(read.error())); }
    return state;
}

std::expected<void, std::string> from_wire(const lockstep_wire_MachineState& wire, MachineState& into) {
    Checks check("machine state");
    check_numbers(wire, check);
    const MachinePhase phase = check.choice("phase", wire.phase, MachinePhase::Jogging);
    const JobOutcome outcome = check.choice("outcome", wire.outcome, JobOutcome::Failed);
    const ProgramDevices devices = devices_from_wire(wire, check);
    const std::string_view writer_name = read_text("writer_name", wire.writer_name, check);
    const std::string_view writer_host = read_text("writer_host", wire.writer_host, check);
    const std::optional<ProbeResult> probe = probe_from_wire(wire, check);
    const std::optional<HomedByTouch> homing = homing_from_wire(wire, check);
    pause_from_wire(wire, into.pause, check);
    if (!check.passed()) { return std::unexpected(check.refusal()); }
    const auto fault = static_cast<FaultCode>(wire.fault);
    into = {.term = {wire.term, wire.coordinator},
            .stamp = wire.stamp,
            .tick = {wire.tick},
            .phase = phase,
            .fault = fault,
            .fault_motor = is_of_an_axis(fault) ? std::optional(MotorIndex{wire.fault_axis}) : std::nullopt,
            .epoch = wire.epoch,
            .sent = wire.sent,
            .veto = wire.has_veto ? std::optional(wire.veto) : std::nullopt,
            .job = wire.job,
            .outcome = wire.has_outcome ? std::optional(outcome) : std::nullopt,
            .job_begun = {wire.job_term, wire.job_coordinator},
            .line = if_positive(wire.line),
            .job_fault = static_cast<FaultCode>(wire.job_fault),
            .lacks_blocks = wire.lacks_blocks,
            .progress = wire.progress,
            .remaining_s = wire.remaining_s,
            .overrides = {wire.feed_percent, wire.rapid_percent},
            .motors_present = MotorSet::of_bits(wire.axes_present),
            .config_hash = wire.config_hash,
            .devices = devices,
            .devices_after = wire.has_devices_after ? std::optional<Epoch>(wire.devices_after) : std::nullopt,
            .lease = std::move(into.lease),
            .pause = std::move(into.pause),
            .probe = probe,
            .job_kind = wire.is_run ? JobKind::Run : JobKind::Move,
            .program = if_positive(wire.program),
            .events_from = wire.events_from,
            .homing = homing,
            .published = {.job_events = wire.job_messages, .program_parts = wire.program_messages},
            .lost_records = wire.lost_records,
            .process = {.reopened = wire.reopened, .lost_log_lines = wire.lost_log_lines}};
    for (const auto& rest : std::span(wire.rests._buffer, wire.rests._length)) {
        into.rests.append(rest_from_wire(rest));
    }
    for (const std::int64_t steps : places_of(wire.leg_from)) { into.leg_from.append(steps); }
    if (!wire.has_writer) {
        into.lease.reset();
        return {};
    }
    HeldLease& lease = into.lease ? *into.lease : into.lease.emplace();
    lease.writer.id = wire.writer;
    lease.writer.name = writer_name;
    lease.writer.host = writer_host;
    lease.since = {wire.writer_since};
    return {};
}

}  // namespace lockstep
