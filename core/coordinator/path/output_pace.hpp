// The speed at which the changes of outputs along a path still fit into frames and their tails.
#pragma once

#include <algorithm>
#include <cmath>
#include <cstddef>
#include <cstdint>
#include <limits>
#include <span>
#include <vector>

#include "core/coordinator/path/touched_outputs.hpp"
#include "core/machine.hpp"
#include "core/path/path_input.hpp"
#include "core/program.hpp"
#include "core/protocol/frame_room.hpp"

namespace lockstep {

class OutputPace {
public:
    explicit OutputPace(const MachineConfig& machine)
        : touched_(machine.outputs),
          room_(output_room(machine.timing)),
          frame_ticks_(static_cast<double>(machine.frame_ticks().value)) {
        const double tick_s = static_cast<double>(machine.tick_ns) * 1e-9;
        for (const AxisConfig& axis : machine.axes) {
            decelerations_.push_back(axis.max_decel_mm_s2 * tick_s * tick_s);
        }
    }

    /// An event before the next move or rest.
    void add(const ProgramEvent& event) { touched_.add(event); }

    /// The next move or rest has changes at its begin. Otherwise nothing limits it.
    bool is_pending() const { return touched_.changes() > 0; }

    /// The greatest speed of the next move, in mm per tick: one that is as long as the next ones, goes their way, and
    /// has as many changes at its begin. `way_mm`: of each axis, at most `length_mm`. A move without length leaves the
    /// events to the next one.
    double next_move(double length_mm, std::span<const double> way_mm) {
        if (!is_pending() || is_left_out(length_mm)) { return std::numeric_limits<double>::infinity(); }
        double deceleration = std::numeric_limits<double>::infinity();
        for (std::size_t i = 0; i < way_mm.size(); ++i) {
            if (way_mm[i] == 0) { continue; }
            deceleration = std::min(deceleration, decelerations_[i] * length_mm / std::abs(way_mm[i]));
        }
        const double apart_mm = length_mm / static_cast<double>(touched_.changes());
        touched_.clear();
        const double in_body = apart_mm * room_for_events(room_.body) / frame_ticks_;
        const double in_tail = std::sqrt(2 * deceleration * apart_mm * room_for_events(room_.tail));
        return std::min(in_body, in_tail);
    }

    /// The path leaves out moves that are so short.
    static bool is_left_out(double length_mm) { return length_mm < PathInput::kLeastMove_mm; }

    /// How long the next rest lasts at least, if all rests have as many changes at their begin.
    Ticks next_rest() {
        const auto changes = static_cast<double>(touched_.changes());
        touched_.clear();
        return {static_cast<std::int64_t>(std::ceil(changes * frame_ticks_ / room_for_events(room_.body)))};
    }

private:
    double room_for_events(std::size_t room) const { return static_cast<double>(room - touched_.besides()); }

    TouchedOutputs touched_;
    OutputRoom room_;
    double frame_ticks_;
    std::vector<double> decelerations_;  // of each axis, mm per tick^2
};

}  // namespace lockstep
