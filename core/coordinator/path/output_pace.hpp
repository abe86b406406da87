// The speed at which the changes of outputs along a path still fit into frames and their tails.
#pragma once

#include <algorithm>
#include <cmath>
#include <cstddef>
#include <limits>
#include <utility>

#include "core/machine.hpp"
#include "core/program.hpp"
#include "core/protocol/frame_room.hpp"

namespace lockstep {

class OutputPace {
public:
    explicit OutputPace(const MachineConfig& machine)
        : has_outputs_(!machine.outputs.empty()),
          room_(output_room(machine.timing)),
          frame_ticks_(static_cast<double>(machine.frame_ticks().value)) {
        const double tick_s = static_cast<double>(machine.tick_ns) * 1e-9;
        double weakest = std::numeric_limits<double>::infinity();
        for (const AxisConfig& axis : machine.axes) { weakest = std::min(weakest, axis.max_decel_mm_s2); }
        deceleration_ = weakest * tick_s * tick_s;
    }

    /// An event before the next move. Those of one kind change outputs at the same tick together.
    void add(const ProgramEvent& event) { (event.is_analog() ? analog_ : digital_) = 1; }

    /// The greatest speed of the next move, in mm per tick: one that is as long as the next ones, and has as many
    /// changes at its begin. A tail slows down by at least the weakest axis's deceleration.
    double next(double length_mm) {
        const double changes = std::exchange(analog_, 0) + std::exchange(digital_, 0);
        if (!has_outputs_ || changes == 0 || length_mm <= 0) { return std::numeric_limits<double>::infinity(); }
        const double apart_mm = length_mm / changes;
        const double in_body = apart_mm * static_cast<double>(room_.body - 1) / frame_ticks_;
        const double in_tail = std::sqrt(2 * deceleration_ * apart_mm * static_cast<double>(room_.tail - 1));
        return std::min(in_body, in_tail);
    }

private:
    bool has_outputs_;
    OutputRoom room_;
    double frame_ticks_;
    double deceleration_;  // mm per tick^2
    double analog_ = 0;
    double digital_ = 0;
};

}  // namespace lockstep
