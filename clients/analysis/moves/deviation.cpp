#include "clients/analysis/moves/deviation.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <cstddef>

#include "core/axis_unit.hpp"
#include "core/enumeration.hpp"

namespace lockstep::analysis {
namespace {

struct MovingParts {
    bool slides = false;
    bool rotates = false;

    void add(const std::string& axis) { (is_rotary(axis) ? rotates : slides) = true; }
    MotionUnit unit() const {
        if (!rotates) { return MotionUnit::Mm; }
        return slides ? MotionUnit::MmAndDeg : MotionUnit::Deg;
    }
};

/// Of all axes of the machine.
MotionUnit motion_unit(const MachineConfig& machine) {
    MovingParts parts;
    for (const AxisConfig& axis : machine.axes) { parts.add(axis.name); }
    return parts.unit();
}

}  // namespace

std::string_view name_of(MotionUnit unit) { return pick_name({"mm", "deg", "mm and deg"}, unit); }

MotionUnit motion_unit(const MachineConfig& machine, const Kinematics& kinematics, const MoveLog& move) {
    AxisSet moved;
    for (const MotorIndex m : motor_indices(std::min(move.motors.size(), kinematics.motors().size()))) {
        const bool takes_part = move.motors[m].asked_steps != 0 || move.motors[m].made_steps != 0;
        if (takes_part) { moved |= kinematics.axes_of_motor(m); }
    }
    MovingParts parts;
    for (const AxisIndex axis : moved) { parts.add(machine.axes[axis].name); }
    return parts.unit();
}

Deviations deviations(const MachineConfig& machine, const Kinematics& kinematics, std::span<const MoveLog> moves,
                      std::int64_t move_count, std::optional<double> largest) {
    if (!largest) { return {}; }
    if (std::ssize(moves) < move_count) { return {{motion_unit(machine), *largest}}; }
    Deviations found;
    for (const MoveLog& move : moves) {
        if (move.largest_distance_mm) {
            add(found, {{motion_unit(machine, kinematics, move), *move.largest_distance_mm}});
        }
    }
    return found;
}

void add(Deviations& all, const Deviations& more) {
    for (const Deviation& one : more) {
        const auto known = std::ranges::find(all, one.unit, &Deviation::unit);
        known == all.end() ? all.push_back(one) : void(known->largest = std::max(known->largest, one.largest));
    }
    std::ranges::sort(all, {}, &Deviation::unit);
}

std::string to_text(const Deviations& found) {
    std::string text;
    for (const auto& [unit, largest] : found) {
        const bool is_one = unit != MotionUnit::MmAndDeg;
        text += text.empty() ? "" : ", ";
        text += is_one ? fmt::format("{:.4f} {}", largest, name_of(unit))
                       : fmt::format("{0:.4f} mm and {0:.4f} deg", largest);
    }
    return text;
}

}  // namespace lockstep::analysis
