#include "services/wire/checks.hpp"
#include "services/wire/translate.hpp"

namespace lockstep {

static_assert(lockstep_wire_MACHINE_STANDBY == static_cast<int>(MachinePhase::Standby));
static_assert(lockstep_wire_JOB_FAILED == static_cast<int>(JobOutcome::Failed));

lockstep_wire_MachineState to_wire(const MachineState& state) {
    return {.term = state.term.number,
            .coordinator = state.term.coordinator,
            .stamp = state.stamp,
            .tick = state.tick.value,
            .phase = static_cast<lockstep_wire_MachinePhase>(state.phase),
            .fault = state.fault,
            .fault_axis = state.fault_axis,
            .epoch = state.epoch,
            .sent = state.sent,
            .has_veto = state.veto.has_value(),
            .veto = state.veto.value_or(0),
            .job = state.job,
            .has_outcome = state.outcome.has_value(),
            .outcome = static_cast<lockstep_wire_JobOutcome>(state.outcome.value_or(JobOutcome::Done)),
            .line = state.line,
            .progress = state.progress,
            .remaining_s = state.remaining_s,
            .feed_percent = static_cast<std::uint16_t>(state.overrides.feed_percent),
            .rapid_percent = static_cast<std::uint16_t>(state.overrides.rapid_percent),
            .axes_present = state.axes_present,
            .config_hash = state.config_hash};
}

FromWire<MachineState> from_wire(const lockstep_wire_MachineState& wire) {
    Checks check("machine state");
    check.far("stamp", wire.stamp);
    check.far("tick", wire.tick);
    check.within<std::size_t>("fault_axis", wire.fault_axis, 0, kMaxAxes - 1);
    check.within("progress", wire.progress, 0.0, 1.0);
    check.finite("remaining_s", wire.remaining_s);
    check.within<int>("feed_percent", wire.feed_percent, Overrides::kLeast, Overrides::kMost);
    check.within<int>("rapid_percent", wire.rapid_percent, Overrides::kLeast, Overrides::kMost);
    const MachinePhase phase = check.choice("phase", wire.phase, MachinePhase::Standby);
    const JobOutcome outcome = check.choice("outcome", wire.outcome, JobOutcome::Failed);
    if (!check.passed()) { return std::unexpected(check.refusal()); }
    return MachineState{.term = {wire.term, wire.coordinator},
                        .stamp = wire.stamp,
                        .tick = {wire.tick},
                        .phase = phase,
                        .fault = wire.fault,
                        .fault_axis = wire.fault_axis,
                        .epoch = wire.epoch,
                        .sent = wire.sent,
                        .veto = wire.has_veto ? std::optional(wire.veto) : std::nullopt,
                        .job = wire.job,
                        .outcome = wire.has_outcome ? std::optional(outcome) : std::nullopt,
                        .line = wire.line,
                        .progress = wire.progress,
                        .remaining_s = wire.remaining_s,
                        .overrides = {wire.feed_percent, wire.rapid_percent},
                        .axes_present = wire.axes_present,
                        .config_hash = wire.config_hash};
}

}  // namespace lockstep
