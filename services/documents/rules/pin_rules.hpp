// The rules of `pins`: what a motor needs of the pins of its device.
#pragma once

#include <string>
#include <vector>

#include "core/machine.hpp"
#include "services/documents/problem_list.hpp"

namespace lockstep {

/// Adds the values that are outside their ranges. at: the block's place, such as "pins." or "motor[1].pins.".
void check_pin_ranges(const PinsConfig& pins, const std::string& at, ProblemList& problems);

}  // namespace lockstep
