// Writes an axis's notices to its log.
#pragma once

#include "core/axis/axis_controller.hpp"

namespace lockstep {

void log_notice(const AxisNotice& notice);

}  // namespace lockstep
