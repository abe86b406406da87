// What goes wrong in a virtual machine, as data: a run's faults are a schedule of these.
#pragma once

#include <cstdint>
#include <optional>

#include "core/units.hpp"

namespace lockstep {

/// Processes are numbered: the axes as configured, then the coordinators.
struct VirtualFault {
    enum class Kind : std::uint8_t {
        Freeze,  // the process's loop does not run; what is sent to it waits; its device goes on
        Crash,   // the process ends, what is sent to it is lost, its device goes on; at the end another takes its place
        Cut,     // messages between the process and its peers are lost
    };
    Kind kind = Kind::Freeze;
    std::size_t process = 0;
    Tick at;
    Ticks lasts;
    std::optional<std::size_t> peer;  // Cut: of this link only; none: of the links with all others
    bool outgoing = true;             // Cut: what the process says is lost
    bool incoming = true;             // Cut: what is said to it is lost

    constexpr Tick end() const { return at + lasts; }
};

}  // namespace lockstep
