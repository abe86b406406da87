// The part of the machine's state that senders of grbl's protocol can read.
#pragma once

#include <cstdint>
#include <optional>
#include <vector>

#include "core/faults.hpp"
#include "core/gcode/kept_values.hpp"
#include "core/overrides.hpp"
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
    std::int32_t line = 0;        // of the program in motion; 0: none
    Overrides overrides;
    gcode::KeptValues values;

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

}  // namespace lockstep::grbl
