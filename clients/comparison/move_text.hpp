// A planned move in the notation of the command line.
#pragma once

#include <expected>
#include <string>
#include <string_view>

#include "core/methods/method.hpp"

namespace lockstep::comparison {

/// The move of Fig. 6 in D. Carrica, M. A. Funes, S. A. González, "Novel stepper motor controller".
inline constexpr std::string_view kDefaultMove = "12000,500,6000,4200";

/// "STEPS,START,MAX,ACCEL[,DECEL]" in steps, steps/s and steps/s^2; without DECEL it is ACCEL. Error: what is wrong,
/// with an example; also a move that fails methods::check().
std::expected<StepMove, std::string> parse_move(std::string_view text);

/// "12000 steps, 500 to 6000 steps/s, 4200 steps/s²"
std::string move_text(const StepMove& move);

}  // namespace lockstep::comparison
