// A number as a person would write it.
#pragma once

#include <string>

namespace lockstep {

/// With nine digits at most, as few as say it.
std::string number_text(double value);
/// With six digits at most: for limits and remedies in messages.
std::string short_number(double value);

}  // namespace lockstep
