// What goes wrong in a virtual machine, as data: a run's faults are a schedule of these.
#pragma once

#include <cstdint>
#include <optional>

#include "core/units.hpp"
#include "sim_fpga/plant.hpp"

namespace lockstep {

/// Processes are numbered: the axes as configured, then the coordinators.
struct VirtualFault {
    enum class Kind : std::uint8_t {
        Freeze,  // the process's loop does not run; what is sent to it waits; its device goes on
        Crash,   // the process ends, what is sent to it is lost, its device goes on; at the end another takes its place
        Cut,     // messages between the process and its peers are lost
        SetClock,     // an axis's process finds its clock set; it lasts until that can have been noticed
        Stick,        // a switch of an axis reads closed, or open, wherever its slide is
        Push,         // a hand moves an axis's slide
        DamageFrame,  // the newest frame that an axis's device holds is altered
        StopDevice,   // an axis's device does nothing; at the end it goes on
        KillDevice,   // it is gone; at the end another one is there, and the slide where it was
        Overwrite,    // its registers are overwritten; at the end it is powered up again
    };
    Kind kind = Kind::Freeze;
    std::size_t process = 0;
    Tick at;
    Ticks lasts;
    std::optional<std::size_t> peer;                 // Cut: of this link only; none: of the links with all others
    bool in_loop = false;                            // Freeze: between what a loop decides and what it does about it
    Ticks set_by;                                    // SetClock: forward
    PlantContact contact = &PlantInputs::limit_min;  // Stick: which
    bool closed = true;                              // Stick: reads closed
    std::int64_t push_steps = 0;                     // Push
    bool reboots = false;                            // Crash: of a coordinator's host, whose clock then begins again
    bool other_config = false;                       // Crash: what takes its place reads another configuration
    bool ends_elsewhere = false;                     // DamageFrame: it joins the frame before and ends elsewhere
    bool garbage = true;                             // Overwrite: with noise; else with zeros
    bool outgoing = true;                            // Cut: what the process says is lost
    bool incoming = true;                            // Cut: what is said to it is lost

    constexpr Tick end() const { return at + lasts; }
    /// Of an axis's slide, switches or device, not of processes or links.
    constexpr bool is_of_plant() const {
        return kind == Kind::Stick || kind == Kind::Push || kind == Kind::DamageFrame || is_of_device();
    }
    /// The device is lost to its axis if it lasts.
    constexpr bool is_of_device() const {
        return kind == Kind::StopDevice || kind == Kind::KillDevice || kind == Kind::Overwrite;
    }
};

}  // namespace lockstep
