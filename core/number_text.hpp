// A number as a person would write it.
#pragma once

#include <string>

namespace lockstep {

/// With at most nine digits, without trailing zeros.
std::string number_text(double value);
/// With at most six digits, for limits and remedies in messages.
std::string short_number(double value);

}  // namespace lockstep
