// The switches of axes, at any device: of those that home by touch, and limit switches at which the coordinator stops
// the machine. Each closes where its axis truly is, whichever motors move that axis.
#pragma once

#include <cstddef>
#include <functional>
#include <span>
#include <string>
#include <vector>

#include "core/kinematics/kinematics.hpp"
#include "core/machine.hpp"
#include "sim_fpga/contacts/reach.hpp"

namespace lockstep {

class AxisSwitches {
public:
    /// `motor`: follows only the inputs of this motor's device; empty: all.
    explicit AxisSwitches(const MachineConfig& machine, const std::string& motor = {});

    bool none() const { return switches_.empty(); }
    /// Calls set(input, closed) for each switch that changes while the slides of the motors are at these places.
    void follow(std::span<const Position> slides, const std::function<void(std::size_t, bool)>& set);
    /// Call it before each interval of motion of so many ticks. Returns whether a switch may change in it.
    bool may_change_within(Ticks next);

private:
    struct Switch {
        std::size_t input = 0;  // of the machine
        AxisIndex axis;
        double at_steps = 0;
        bool toward_min = true;
        bool is_closed = false;
        double steps_per_mm = 1;
        Reach reach{};
        double axis_steps = 0;  // its place now, and at the begin of the interval
        double begun_at_steps = 0;
    };

    void add(std::size_t input, AxisIndex axis, const MachineConfig& machine, double at_mm, bool toward_min);

    Kinematics kinematics_;
    std::vector<Switch> switches_;
    Ticks interval_;
};

}  // namespace lockstep
