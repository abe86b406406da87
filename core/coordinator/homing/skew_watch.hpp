// Watches the motors of each axis while they home, each to its own switch: they must stay together within max_skew_mm.
//
// A motor's place is not known before it has found its switch, so ways since the begin are compared. When a motor sets
// its zero its count jumps: it stood at its switch then, and its way goes on from there. A state may have been damaged
// on its way to the coordinator, so it counts only if the next one agrees with it, and motors are apart only if they
// are so in two slots in a row. States may be lost, so ways are compared at slots of which both motors have one. Motors
// that were homed already may stand further apart than max_skew_mm, after a fault; then homing brings them together,
// and they may not come further apart.
#pragma once

#include <array>
#include <optional>
#include <vector>

#include "core/coordinator/axes/axis_roster.hpp"
#include "core/indices.hpp"
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
    std::optional<MotorIndex> look(const AxisRoster& motors);

private:
    struct Reading {
        bool is_homed = false;
        std::int64_t count = 0;
        Slot slot = 0;
    };
    struct Passed {
        std::optional<Slot> slot;
        double way_mm = 0;
    };
    struct Motor {
        AxisIndex axis;
        double axis_mm_per_step = 0;
        double steps_per_slot = 0;            // at most
        std::optional<double> most_mm;        // the axis's max_skew_mm
        double travel_mm = 0;                 // of the axis
        std::int64_t switch_at = 0;           // its count at its switch, after it has set its zero
        std::optional<double> begin_mm = {};  // of the axis, if it was homed at the begin
        std::optional<Reading> newest = {};   // no other one agrees with it yet
        std::optional<Reading> last = {};     // that counts
        double way_mm = 0;                    // of the axis, since the begin
        std::array<Passed, 16> passed = {};   // the newest ways, by the slot's remainder
    };

    static void take(const Reading& reading, Motor& motor);
    static bool agrees(const Reading& one, const Reading& next, const Motor& motor);
    static bool are_apart(const Motor& one, const Motor& other);

    std::vector<Motor> motors_;  // empty if no axis has several
};

}  // namespace lockstep
