// The part of the machine's state that senders of grbl's protocol can read.
#pragma once

#include <cstdint>
#include <optional>
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
    bool is_received = false;  // the coordinator is, and every axis; nothing else is meaningful before
    MachinePhase phase = MachinePhase::Waiting;
    FaultCode fault = FaultCode::None;
    std::vector<AxisPlace> axes;  // by the configuration
    double feed_mm_min = 0;       // of the axes together, now
    std::int32_t line = 0;        // of the program in motion, or the N word of the sender's line; 0: none
    Overrides overrides;
    ProgramDevices devices;
    gcode::KeptValues values;
    // Of the sender's lines that were accepted:
    std::size_t lines = 0;     // not run yet
    bool is_held = false;      // they wait for a resume, before the machine has begun with them
    bool is_stopping = false;  // they were dropped, and the machine is not known to rest yet

    bool is_at_rest() const {
        for (const AxisPlace& axis : axes) {
            if (!axis.at_rest) { return false; }
        }
        return true;
    }
    bool is_homed() const {
        for (const AxisPlace& axis : axes) {
            if (!axis.homed) { return false; }
        }
        return true;
    }
};

/// `axes`: the newest state of each; null: none was received. The rest of the view is the caller's.
MachineView view_of(const MachineConfig& machine, const MachineState& state, const std::vector<const AxisState*>& axes);

}  // namespace lockstep::grbl
