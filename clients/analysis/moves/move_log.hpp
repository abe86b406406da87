// One move of a job, as it was commanded and as it was made.
#pragma once

#include <cstdint>
#include <optional>
#include <vector>

#include "clients/analysis/measure/tick_histogram.hpp"
#include "core/units.hpp"

namespace lockstep::analysis {

/// One motor in one move.
struct MotorMove {
    std::int64_t asked_steps = 0;
    std::int64_t made_steps = 0;
    std::int64_t slack_steps = 0;    // by which a correct job may differ here (AskedPath::slack)
    double peak_steps_per_tick = 0;  // from SpeedMeter; its window may reach into the previous move
    double peak_steps_per_tick2 = 0;
};

struct MoveLog {
    std::int32_t line = 0;  // of the program
    double length_mm = 0;
    Ticks planned;
    /// Total duration: from the lead motor's first step to its last, plus the planned times before and after. nullopt
    /// without steps.
    std::optional<Ticks> made;
    /// Of the place after any step from the commanded line; of machines whose motors are not their axes, after all
    /// steps of a tick. nullopt if motors moved on their own, or if steps are missing or came too late in the log.
    std::optional<double> largest_distance_mm;
    std::optional<Tick> first;      // step of the motor with the most steps
    TickHistogram late;             // of its steps, against the commanded ticks
    Ticks skew;                     // largest lateness of its steps minus the smallest
    std::vector<MotorMove> motors;  // in the order of motors_of
    bool is_whole() const;
};

}  // namespace lockstep::analysis
