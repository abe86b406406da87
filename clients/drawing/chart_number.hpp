// Writes the numbers of charts fast.
#pragma once

#include <string>

namespace lockstep::drawing {

/// Appends a finite number with nine significant digits, as many as a chart can show, and no trailing zeros.
void append_chart_number(std::string& text, double value);

}  // namespace lockstep::drawing
