// The figures of a comparison.
#pragma once

#include "clients/drawing/figure.hpp"
#include "clients/methods/comparison.hpp"

namespace lockstep::comparison {

/// Speed over time of all methods and of the ideal, then the error of each method's step times.
drawing::Figure comparison_figure(const Comparison& comparison);

/// The six lines without and with the DDA (lines.hpp), with few pulses to a unit so that they are visible.
drawing::Figure lines_figure();

}  // namespace lockstep::comparison
