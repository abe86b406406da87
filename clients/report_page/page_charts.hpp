// The data that the report page draws, as JSON: rows over time of every axis, the path, and the step time errors.
#pragma once

#include <string>

#include "clients/analysis/analysis.hpp"

namespace lockstep::analysis {

/// {whole: [s, s], rows: [{kind, name, what, unit, colour, x, y, limits, missing}], path: {asked, stepped} or null,
/// powers: [{output, summary, cell_mm, left, bottom, width, height, unknown, maps: [{name, unit, asked, made}]}],
/// step_times: [{name, colour, classes, counts}]}. Rows of inputs and outputs also have {filled, levels: [name of 0,
/// name of 1] or null, words: [{at_s, what}]}. x: seconds after the first step. A null interrupts a curve.
std::string page_charts(const Analysis& analysis);

}  // namespace lockstep::analysis
