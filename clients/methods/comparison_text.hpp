// A comparison as text, CSV or HTML.
#pragma once

#include <string>

#include "clients/methods/comparison.hpp"

namespace lockstep::comparison {

/// Tables of the methods and of the lines, and a sentence for each method that changed or refused the move.
std::string to_text(const Comparison& comparison);

/// Every step: method, number of the step, time and error.
std::string to_csv(const Comparison& comparison);

/// The tables and the figures as one self-contained page.
std::string to_html(const Comparison& comparison);

}  // namespace lockstep::comparison
