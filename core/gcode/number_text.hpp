// A number as a person would write it, to nine digits.
#pragma once

#include <string>

namespace lockstep {

std::string number_text(double value);

}  // namespace lockstep
