#include "clients/analysis/moves/move_log.hpp"

#include <algorithm>
#include <cstdlib>

namespace lockstep::analysis {

bool MoveLog::is_whole() const {
    return std::ranges::all_of(
        motors, [](const MotorMove& of) { return std::abs(of.made_steps - of.asked_steps) <= of.slack_steps; });
}

}  // namespace lockstep::analysis
