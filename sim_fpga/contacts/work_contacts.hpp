// The inputs of probes that a simulated workpiece closes, wherever the slides of the machine's motors are.
#pragma once

#include <cstddef>
#include <functional>
#include <span>
#include <string>
#include <vector>

#include "core/kinematics/kinematics.hpp"
#include "core/machine.hpp"
#include "sim_fpga/contacts/reach.hpp"
#include "sim_fpga/contacts/workpiece.hpp"

namespace lockstep {

class WorkContacts {
public:
    /// `motor`: follows only the inputs of this motor's device; empty: all.
    explicit WorkContacts(const MachineConfig& machine, const std::string& motor = {});

    /// There is no workpiece, or no input of a probe.
    bool none() const { return contacts_.empty(); }
    /// Calls set(input, closed) for each input that changes while the slides of the motors are at these places.
    void follow(std::span<const Position> slides, const std::function<void(std::size_t, bool)>& set);
    /// Call it before each interval of motion of so many ticks. Returns whether an input may change in it.
    bool may_change_within(Ticks next);

private:
    struct Contact {
        std::size_t input = 0;  // of the machine
        int probe = 0;
        bool is_closed = false;
        double gap_mm = 0;
    };
    WorkPlace place_of(std::span<const Position> slides) const;

    Kinematics kinematics_;
    Workpiece work_;
    std::vector<AxisIndex> axes_;  // X, Y and Z
    std::vector<double> step_mm_;  // of each axis of the machine
    Reach reach_;                  // of their way
    double rounded_mm_ = 0;
    std::vector<Contact> contacts_;
    WorkPlace place_;  // now, and at the begin of the interval
    WorkPlace begun_at_;
    Ticks interval_;
};

}  // namespace lockstep
