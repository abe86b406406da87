// Everything that the slides of a machine's motors touch: the switches of its axes, and its workpiece.
#pragma once

#include <cstddef>
#include <functional>
#include <span>
#include <string>

#include "sim_fpga/contacts/axis_switches.hpp"
#include "sim_fpga/contacts/work_contacts.hpp"

namespace lockstep {

class SlideContacts {
public:
    /// `motor`: follows only the inputs of this motor's device; empty: all.
    explicit SlideContacts(const MachineConfig& machine, const std::string& motor = {})
        : switches_(machine, motor), work_(machine, motor) {}

    bool none() const { return switches_.none() && work_.none(); }
    /// Calls set(input, closed) for each input that changes while the slides of the motors are at these places.
    void follow(std::span<const Position> slides, const std::function<void(std::size_t, bool)>& set) {
        switches_.follow(slides, set);
        work_.follow(slides, set);
    }
    /// Call it before each interval of motion of so many ticks. Returns whether an input may change in it.
    bool may_change_within(Ticks next) {
        const bool may_close = switches_.may_change_within(next);
        return work_.may_change_within(next) || may_close;
    }

private:
    AxisSwitches switches_;
    WorkContacts work_;
};

}  // namespace lockstep
