#include <algorithm>

#include "core/if_positive.hpp"
#include "services/wire/translate/checks.hpp"
#include "services/wire/translate/translate.hpp"

namespace lockstep {

constexpr std::int64_t kLongestClockError = std::int64_t{1} << 62;
constexpr std::uint64_t kMostOrders = std::uint64_t{1} << 62;  // leaves room for later numbers

namespace {

// Bits of AxisState.switches, as in axis.idl.
constexpr std::uint16_t kLimitMinBit = 1;
constexpr std::uint16_t kLimitMaxBit = 2;
constexpr std::uint16_t kHomeBit = 4;

std::uint16_t to_bits(const Switches& switches) {
    return static_cast<std::uint16_t>((switches.limit_min ? kLimitMinBit : 0) |
                                      (switches.limit_max ? kLimitMaxBit : 0) | (switches.home ? kHomeBit : 0));
}

AnalogLevels analog_of(const lockstep_wire_AxisState& wire, Checks& check) {
    AnalogLevels levels;
    std::ranges::copy(wire.analog, levels.begin());
    for (const std::uint16_t level : levels) {
        check.within<std::uint16_t>("the level of an analog output", level, 0, kFullAnalogLevel);
    }
    return levels;
}

}  // namespace

// The enumerations on the wire have the same order as those in core.
static_assert(lockstep_wire_AXIS_FAULT == static_cast<int>(AxisPhase::Fault));
static_assert(lockstep_wire_AXIS_CORRECT == static_cast<int>(AxisCommandKind::Correct));

lockstep_wire_AxisState to_wire(const AxisState& state) {
    lockstep_wire_AxisState wire = {.axis = state.axis,
                                    .corrected_steps = state.corrected_steps,
                                    .identity = state.identity,
                                    .stamp = state.stamp,
                                    .epoch = state.epoch,
                                    .held = state.held,
                                    .has_veto = state.veto.has_value(),
                                    .veto = state.veto.value_or(0),
                                    .ran = state.ran,
                                    .at_rest = state.at_rest,
                                    .homed = state.homed,
                                    .phase = static_cast<lockstep_wire_AxisPhase>(state.phase),
                                    .fault = static_cast<std::uint16_t>(state.fault),
                                    .play_steps = static_cast<std::int32_t>(state.play_steps),
                                    .position_count = state.position.count(),
                                    .position_phase = state.position.phase(),
                                    .velocity = state.velocity.raw,
                                    .tick = state.tick.value,
                                    .following_error_steps = state.following_error_steps,
                                    .command_done = state.command_done,
                                    .command_fault = static_cast<std::uint16_t>(state.command_fault),
                                    .config_hash = state.config_hash,
                                    .refused_frames = state.refused_frames,
                                    .clock_error_ticks = state.clock_error.value,
                                    .term = state.term.number,
                                    .coordinator = state.term.coordinator,
                                    .hears_owner = state.hears_owner,
                                    .unproved = static_cast<std::uint16_t>(state.unproved),
                                    .switches = to_bits(state.switches),
                                    .inputs = state.inputs,
                                    .outputs = state.outputs,
                                    .homing = static_cast<std::uint16_t>(state.homing),
                                    .pulses_left = state.pulses_left,
                                    .analog = {},
                                    .has_touch = state.touch.has_value(),
                                    .touch_channel = state.touch.value_or(EpochTouch{}).channel,
                                    .ceased = state.ceased,
                                    .touch_epoch = state.touch.value_or(EpochTouch{}).epoch,
                                    .touch_tick = state.touch.value_or(EpochTouch{}).tick.value};
    std::ranges::copy(state.analog, wire.analog);
    return wire;
}

FromWire<AxisState> from_wire(const lockstep_wire_AxisState& wire) {
    Checks check("axis state");
    check.within<std::size_t>("axis", wire.axis, 0, kMaxAxes - 1);
    check.far("stamp", wire.stamp);
    check.far("position_count", wire.position_count);
    check.rate("velocity", wire.velocity);
    check.far("tick", wire.tick);
    check.far("following_error_steps", wire.following_error_steps);
    check.within<std::uint64_t>("command_done", wire.command_done, 0, kMostOrders);
    check.far("touch_tick", wire.touch_tick);
    check.within<std::size_t>("touch_channel", wire.touch_channel, 0, kMostInputs - 1);
    check.within<std::int64_t>("clock_error_ticks", wire.clock_error_ticks, 0, kLongestClockError);
    const AxisPhase phase = check.choice("phase", wire.phase, AxisPhase::Fault);
    check.within("homing", wire.homing, std::uint16_t{0}, static_cast<std::uint16_t>(HomingStage::Release));
    const AnalogLevels analog = analog_of(wire, check);
    if (!check.passed()) { return std::unexpected(check.refusal()); }
    return AxisState{.identity = wire.identity,
                     .axis = wire.axis,
                     .stamp = wire.stamp,
                     .epoch = wire.epoch,
                     .held = wire.held,
                     .veto = wire.has_veto ? std::optional(wire.veto) : std::nullopt,
                     .ran = wire.ran,
                     .at_rest = wire.at_rest,
                     .homed = wire.homed,
                     .phase = phase,
                     .fault = static_cast<FaultCode>(wire.fault),
                     .position = Position::from_count(wire.position_count, wire.position_phase),
                     .velocity = {wire.velocity},
                     .tick = {wire.tick},
                     .following_error_steps = wire.following_error_steps,
                     .corrected_steps = wire.corrected_steps,
                     .play_steps = wire.play_steps,
                     .command_done = wire.command_done,
                     .command_fault = static_cast<FaultCode>(wire.command_fault),
                     .config_hash = wire.config_hash,
                     .refused_frames = wire.refused_frames,
                     .clock_error = {wire.clock_error_ticks},
                     .term = {wire.term, wire.coordinator},
                     .hears_owner = wire.hears_owner,
                     .unproved = static_cast<FaultCode>(wire.unproved),
                     .switches = {.limit_min = (wire.switches & kLimitMinBit) != 0,
                                  .limit_max = (wire.switches & kLimitMaxBit) != 0,
                                  .home = (wire.switches & kHomeBit) != 0},
                     .homing = static_cast<HomingStage>(wire.homing),
                     .inputs = wire.inputs,
                     .outputs = wire.outputs,
                     .pulses_left = wire.pulses_left,
                     .analog = analog,
                     .touch = wire.has_touch
                                  ? std::optional(EpochTouch{wire.touch_epoch, {wire.touch_tick}, wire.touch_channel})
                                  : std::nullopt,
                     .ceased = wire.ceased};
}

lockstep_wire_AxisCommand to_wire(const AxisCommand& command) {
    return {.term = command.term.number,
            .coordinator = command.term.coordinator,
            .sequence_number = command.sequence,
            .axis = command.axis,
            .kind = static_cast<lockstep_wire_AxisCommandKind>(command.kind),
            .target_steps = command.target_steps,
            .ticks = command.ticks.value_or(Ticks{}).value,
            .speed_mm_s = command.speed_mm_s,
            .until = command.until.value};
}

FromWire<AxisCommand> from_wire(const lockstep_wire_AxisCommand& wire) {
    Checks check("axis command");
    check.within<std::uint64_t>("sequence", wire.sequence_number, 0, kMostOrders);
    check.within<std::size_t>("axis", wire.axis, 0, kMaxAxes - 1);
    const AxisCommandKind kind = check.choice("kind", wire.kind, AxisCommandKind::Correct);
    check.far("target_steps", wire.target_steps);
    check.within<std::int64_t>("ticks", wire.ticks, 0, kMaxWireTicks);
    check.finite("speed_mm_s", wire.speed_mm_s);
    check.far("until", wire.until);
    if (!check.passed()) { return std::unexpected(check.refusal()); }
    return AxisCommand{.term = {wire.term, wire.coordinator},
                       .sequence = wire.sequence_number,
                       .axis = wire.axis,
                       .kind = kind,
                       .target_steps = wire.target_steps,
                       .ticks = if_positive(Ticks{wire.ticks}),
                       .speed_mm_s = wire.speed_mm_s,
                       .until = {wire.until}};
}

}  // namespace lockstep
