// Watches the motors of each axis while they home, each to its own switch: they must stay together within max_skew_mm.
//
// A motor's place is not known before it has found its switch, so ways since the begin are compared. When a motor sets
// its zero its count jumps: it stood at its switch then, and its way goes on from there. A single state may have been
// damaged on the way to the coordinator, so motors are apart only if the states before say so, too. Motors that were
// homed already may stand further apart than max_skew_mm, after a fault; then homing brings them together, and they may
// not come further apart.
#pragma once

#include <optional>
#include <vector>

#include "core/axis_set.hpp"
#include "core/coordinator/axes/axis_roster.hpp"
#include "core/kinematics/kinematics.hpp"
#include "core/machine.hpp"

namespace lockstep {

class SkewWatch {
public:
    SkewWatch() = default;
    /// Allocates nothing if each axis has one motor.
    SkewWatch(const MachineConfig& machine, const Kinematics& kinematics);

    /// The motors begin to home. They stand where they are known to be.
    void begin(const AxisRoster& motors);
    /// Returns a motor that is further from another one of its axis than this may be; nullopt if there is none.
    std::optional<std::size_t> look(const AxisRoster& motors);

private:
    struct Motor {
        std::size_t axis = 0;
        double axis_mm_per_step = 0;
        std::optional<double> most_mm;  // the axis's max_skew_mm
        bool was_homed = false;
        std::int64_t count = 0;      // at the last look
        Slot stamp = 0;              // of the last state
        std::int64_t switch_at = 0;  // its count at its switch, after it has set its zero
        bool is_known = false;       // homed at the begin
        double begin_mm = 0;         // of the axis, if known
        double way_mm = 0;           // of the axis, since the begin
        double before_mm = 0;        // the same by the state before
    };

    static bool are_apart(const Motor& one, const Motor& other);

    std::vector<Motor> motors_;  // empty if no axis has several
};

}  // namespace lockstep
