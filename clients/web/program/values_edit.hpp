// Applies a client's changes to the values that outlive programs. Pure.
#pragma once

#include <expected>
#include <vector>

#include "clients/web/request/orders.hpp"
#include "core/gcode/kept_values.hpp"
#include "services/setup/machine_setup.hpp"

namespace lockstep::web {

/// Sets a coordinate system so that axes that stand at `place_mm` read the order's places. G92 and a rotation keep
/// their effect.
std::expected<gcode::KeptValues, Problem> edited(const TouchOrder& order, const gcode::KeptValues& values,
                                                 const MachineSetup& machine, const std::vector<double>& place_mm);
std::expected<gcode::KeptValues, Problem> edited(const OffsetOrder& order, gcode::KeptValues values);
/// Fails if there is no such tool to remove, or no room for another.
std::expected<gcode::KeptValues, Problem> edited(const ToolOrder& order, gcode::KeptValues values);

}  // namespace lockstep::web
