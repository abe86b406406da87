// The part of the machine's state that senders of grbl's protocol can read.
#pragma once

#include <algorithm>
#include <cstdint>
#include <functional>
#include <optional>
#include <string>
#include <vector>

#include "core/faults.hpp"
#include "core/gcode/kept_values.hpp"
#include "core/machine.hpp"
#include "core/overrides.hpp"
#include "core/program_devices.hpp"
#include "core/protocol/messages.hpp"

namespace lockstep::grbl {

struct AxisPlace {
    double mm = 0;  // machine coordinates
    bool homed = false;
    bool at_rest = true;
    bool operator==(const AxisPlace&) const = default;
};

struct MachineView {
    bool is_received = false;  // the coordinator and every axis are received; else the other fields are meaningless
    MachinePhase phase = MachinePhase::Waiting;
    FaultCode fault = FaultCode::None;
    std::string fault_place;  // whose fault it is: "axis X", "motor Y2"; empty: no single motor's
    bool is_fault_of_board = false;
    std::vector<AxisPlace> axes;       // in the configuration's order
    double feed_mm_min = 0;            // of all axes together, now
    std::string closed_inputs;         // P: a probe touches; D: a door is open; E: an emergency stop is closed
    std::string closed_switches;       // the letters of the axes with a limit or home switch closed at a motor
    std::optional<std::int32_t> line;  // of the program in motion, or the N word of the sender's line
    Overrides overrides;
    ProgramDevices devices;
    std::string accessories;  // S, C: the spindle turns, forward or reverse; F: flood; M: mist
    gcode::KeptValues values;
    std::optional<ProbeResult> probe;  // of the newest probing move
    std::optional<Pause> pause;        // the job waits for a person
    std::string way_back;              // to the place of the pause; empty if the axes are there
    // About the sender's accepted lines:
    std::size_t lines = 0;     // number of lines not run yet
    bool is_held = false;      // they wait for a resume, and the machine has not begun them
    bool is_stopping = false;  // they were dropped, and the machine may not be at rest yet

    bool is_at_rest() const { return std::ranges::all_of(axes, &AxisPlace::at_rest); }
    bool is_homed() const { return std::ranges::all_of(axes, &AxisPlace::homed); }
};

/// `axes`: the newest state of each axis; null if none was received. The caller sets the other fields of the view.
MachineView view_of(const MachineConfig& machine, const MachineState& state, const std::vector<const AxisState*>& axes,
                    std::span<const double> steps_per_tick);

/// The letters of `Pn` for the machine's inputs that are closed: P for a probe, D for a door, E for an
/// emergency stop. `closed_of`:
/// the closed inputs of a motor's device, by the motor's number; 0 if it was not received.
std::string letters_of_inputs(const MachineConfig& machine,
                              const std::function<std::uint32_t(MotorIndex motor)>& closed_of);

/// The letters of `A`: of the outputs that are on, as their devices report it. A word that no output of the machine
/// follows is shown as the program asks.
/// `state_of`: of a motor, by its number; nullptr if it was not received.
std::string letters_of_outputs(const MachineConfig& machine, const ProgramDevices& asked,
                               const std::function<const AxisState*(MotorIndex motor)>& state_of);

}  // namespace lockstep::grbl
