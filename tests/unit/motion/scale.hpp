// The scale of the two axes in these tests.
#pragma once

#include <vector>

namespace lockstep {

inline constexpr double kStepsPerMm = 100;
inline const std::vector<double> kScale(2, kStepsPerMm);

}  // namespace lockstep
