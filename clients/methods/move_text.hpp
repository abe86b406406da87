// A planned move in the notation of the command line.
#pragma once

#include <expected>
#include <string>
#include <string_view>

#include "core/methods/method.hpp"

namespace lockstep::comparison {

/// The move of Fig. 6 in D. Carrica, M. A. Funes, S. A. González, "Novel stepper motor controller".
inline constexpr std::string_view kDefaultMove = "12000,500,6000,4200";

/// Parses "STEPS,START,MAX,ACCEL[,DECEL]" in steps, steps/s and steps/s^2. DECEL defaults to ACCEL. The error says what
/// is wrong, with an example. A move that fails methods::check() is an error too.
std::expected<StepMove, std::string> parse_move(std::string_view text);

/// "12000 steps, 500 to 6000 steps/s, 4200 steps/s²"
std::string move_text(const StepMove& move);

}  // namespace lockstep::comparison
