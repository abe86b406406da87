// The course of each input and output over time, as a curve, with the words of programs that switch it.
#pragma once

#include <array>
#include <optional>
#include <string>
#include <vector>

#include "clients/analysis/analysis.hpp"
#include "clients/drawing/motion_figures.hpp"

namespace lockstep::analysis {

struct ChannelCurve {
    drawing::AxisCurve curve;                          // its name as the axis; % of full scale, or 0 and 1
    std::optional<std::array<std::string, 2>> levels;  // names of 0 and 1; nullopt if it is analog
    std::vector<double> asked_s;                       // when words of a program switched it, rising
    std::vector<std::string> asked;                    // these words
};

/// Of those that the machine's file names; of all if it is not known. Times are seconds after the log's first step. A
/// curve begins with the first change on record, and is broken where changes may be missing.
std::vector<ChannelCurve> channel_curves(const Analysis& analysis);

/// The seconds that the log's motion lasts, and the changes of outputs shortly after it.
double shown_seconds(const Analysis& analysis);

}  // namespace lockstep::analysis
