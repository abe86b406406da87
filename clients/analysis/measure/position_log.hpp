// The positions that an axis published, and the steps that they show and the log lacks.
#pragma once

#include <cstdint>
#include <optional>
#include <string>

#include "core/machine.hpp"
#include "services/record/reading/positions/motor_zero.hpp"

namespace lockstep::analysis {

/// Where the recorded steps of an axis end; nullopt without steps.
struct StepsEnd {
    std::optional<Tick> tick;                    // of the last step
    std::optional<std::int64_t> position_steps;  // after it
};

class PositionLog {
public:
    void set_machine(const MachineConfig& machine, const std::string& motor) { zero_.set_machine(machine, motor); }
    /// `steps`: those recorded so far.
    void take(const RecordedPosition& sample, const StepsEnd& steps);
    /// A message of steps, of which the newest is at `last`.
    void take_steps(std::optional<Tick> last);

    std::int64_t count() const { return count_; }
    /// Without its sign.
    std::int64_t largest_following_error() const { return following_error_; }
    /// The steps lost that were made up at rest.
    std::int64_t corrected_steps() const { return corrected_; }
    /// From the positions in mm and in steps; nullopt if all are 0.
    std::optional<double> steps_per_mm() const { return steps_per_mm_; }
    /// The steps from the last recorded step to the last position. If these agree, the largest distance of any position
    /// in between, since the axis may have returned. Not 0 if the log ends too early for these steps, or if its end is
    /// lost.
    std::int64_t unrecorded_steps(const StepsEnd& steps) const;

private:
    std::int64_t unrecorded_at(const RecordedPosition& sample, const StepsEnd& steps) const;
    bool takes_over_encoder(const RecordedPosition& sample) const;

    MotorZero zero_;
    std::int64_t count_ = 0;
    std::int64_t following_error_ = 0;
    std::int64_t corrected_ = 0;
    std::int64_t first_steps_ = 0;  // of the first position
    std::optional<RecordedPosition> last_;
    std::optional<RecordedPosition> origin_;    // the first with the newest zero, until steps with it are recorded
    std::optional<RecordedPosition> farthest_;  // since the last message of steps
    std::optional<double> steps_per_mm_;
};

}  // namespace lockstep::analysis
