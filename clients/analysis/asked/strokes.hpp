// The strokes of a motor in a move: its way from each reversal to the next, in whole steps.
#pragma once

#include <cstdint>
#include <functional>

#include "clients/planning/leg_plan.hpp"

namespace lockstep::analysis {

struct PlannedStroke {
    std::int64_t from = 0;  // steps
    std::int64_t to = 0;
    Ticks begin;  // of the planned motion; the motor does not reverse until `end`
    Ticks end;
    bool operator==(const PlannedStroke&) const = default;
};

/// Visits each stroke with steps, in order, between two times of the planned motion.
void each_stroke(const AxisMotion& motion, Ticks begin, Ticks end,
                 const std::function<void(const PlannedStroke&)>& visit);

}  // namespace lockstep::analysis
