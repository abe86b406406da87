// Changes of the values that outlive programs, as a client asks for them. Pure.
#pragma once

#include <expected>
#include <vector>

#include "clients/web/request/orders.hpp"
#include "core/gcode/kept_values.hpp"
#include "core/machine.hpp"

namespace lockstep::web {

/// What the axes read in the coordinate system where they stand, `place_mm`; G92 and a rotation keep their effect.
std::expected<gcode::KeptValues, Problem> edited(const TouchOrder& order, const gcode::KeptValues& values,
                                                 const MachineConfig& machine, const std::vector<double>& place_mm);
std::expected<gcode::KeptValues, Problem> edited(const OffsetOrder& order, gcode::KeptValues values);
/// Error: there is no such tool to remove, or no room for another.
std::expected<gcode::KeptValues, Problem> edited(const ToolOrder& order, gcode::KeptValues values);

}  // namespace lockstep::web
