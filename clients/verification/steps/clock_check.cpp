#include "clients/verification/steps/clock_check.hpp"

#include <fmt/format.h>

#include "core/kinematics/motors.hpp"

namespace lockstep::verification {

/// The motor times its frames by the clock of the coordinator's host.
bool ClockCheck::shares_clock(const std::string& name) const {
    if (machine_->timing.time_source != TimeSource::Shared) { return false; }
    const auto motor = motor_named(*machine_, name);
    return !motor || !estimates_clock(*machine_, *motor);
}

std::optional<std::string> ClockCheck::take(const std::string& axis, const analysis::StepBatch& batch) const {
    if (!machine_ || !shares_clock(axis)) { return std::nullopt; }
    if (batch.clock_error == Ticks{} && batch.ahead_first == Ticks{} && batch.ahead_last == Ticks{}) {
        return std::nullopt;
    }
    return fmt::format(
        "message {} of steps gives times of a clock of its own ({} ticks ahead, within {}), but "
        "the machine's processes share one clock (timing.time_source)",
        batch.sequence, batch.ahead_first.value, batch.clock_error.value);
}

std::optional<std::string> ClockCheck::take(const std::string& axis, const analysis::Run& run) const {
    if (!machine_) { return std::nullopt; }
    if (shares_clock(axis) && (run.clock_error != Ticks{} || run.ahead != Ticks{})) {
        return fmt::format(
            "{} gives times of a clock of its own ({} ticks ahead, within {}), but the machine's "
            "processes share one clock (timing.time_source)",
            name_of(run), run.ahead.value, run.clock_error.value);
    }
    if (run.epoch == 0 || run.clock_error <= most()) { return std::nullopt; }
    return fmt::format(
        "{} was run while machine time was known within {} ticks; {} are allowed "
        "(timing.clock_error_limit_us)",
        name_of(run), run.clock_error.value, machine_->clock_error_limit().value);
}

std::optional<std::string> ClockCheck::take_in_frame(const analysis::Run& run, Ticks error) const {
    if (!machine_ || error <= most() * 2) { return std::nullopt; }  // an improved estimate may shift steps as well
    return fmt::format(
        "steps of {} are known within {} ticks of machine time; {} are allowed "
        "(timing.clock_error_limit_us)",
        name_of(run), error.value, machine_->clock_error_limit().value);
}

}  // namespace lockstep::verification
