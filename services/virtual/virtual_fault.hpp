// A fault of a virtual machine, as data. A run has a schedule of them.
#pragma once

#include <cstdint>
#include <optional>

#include "core/units.hpp"
#include "sim_fpga/plant.hpp"

namespace lockstep {

/// Process numbers: first the axes in the configured order, then the coordinators.
struct VirtualFault {
    enum class Kind : std::uint8_t {
        Freeze,    // the process's loop does not run; messages to it wait; its device continues
        Crash,     // the process ends, messages to it are lost, its device continues; at the end a new process starts
        Cut,       // messages between the process and its peers are lost
        SetClock,  // the clock of an axis's process is set; the fault lasts until this must be detected
        Stick,     // a switch of an axis always reads closed, or always open
        Push,      // a hand moves an axis's slide
        DamageFrame,  // the newest frame that an axis's device holds is altered
        StopDevice,   // an axis's device does nothing; at the end it continues
        KillDevice,   // an axis's device ends; at the end a new one powers up, with the slide where it was
        Overwrite,    // a device's registers are overwritten; at the end it powers up again
    };
    Kind kind = Kind::Freeze;
    std::size_t process = 0;
    Tick at;
    Ticks lasts;
    std::optional<std::size_t> peer;                 // Cut: the link to this process; nullopt: all links
    bool in_loop = false;                            // Freeze: stalls between a loop's decisions and its actions
    Ticks set_by;                                    // SetClock: forward by this
    PlantContact contact = &PlantInputs::limit_min;  // Stick: the switch
    bool closed = true;                              // Stick: reads closed
    std::int64_t push_steps = 0;                     // Push: distance
    bool reboots = false;                            // Crash: a coordinator's host reboots, so its clock restarts
    bool other_config = false;                       // Crash: the next process reads another configuration
    bool ends_elsewhere = false;                     // DamageFrame: the frame joins but ends elsewhere
    bool garbage = true;                             // Overwrite: with noise; false: with zeros
    bool outgoing = true;                            // Cut: messages from the process are lost
    bool incoming = true;                            // Cut: messages to the process are lost

    constexpr Tick end() const { return at + lasts; }
    /// Of an axis's process or device.
    constexpr MotorIndex motor() const { return MotorIndex{process}; }
    /// Whether it is a fault of an axis's slide, switches or device, not of a process or link.
    constexpr bool is_of_plant() const {
        return kind == Kind::Stick || kind == Kind::Push || kind == Kind::DamageFrame || is_of_device();
    }
    /// Whether it is a fault that makes the axis lose its device if it lasts long enough.
    constexpr bool is_of_device() const {
        return kind == Kind::StopDevice || kind == Kind::KillDevice || kind == Kind::Overwrite;
    }
};

}  // namespace lockstep
