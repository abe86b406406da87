// Whether a path of the tool's centre strays from the programmed path. Uses only distances and directions, not the
// rules of cutter compensation.
#pragma once

#include <string>

#include "tests/integration/oracle/rs274.hpp"

namespace lockstep::oracle {

/// Whether, at the line that we refuse, rs274's path comes nearer to the program's path than the tool's radius, runs
/// backward along it, or goes around an arc once more.
bool strays_from_path(const std::string& text, const Reading& theirs, const Reading& ours);

/// Whether the motion of `line` begins or ends where the program's path turns back between an arc and another motion.
bool turns_back_at(const std::string& text, int line);

/// Whether the motion before that of `line` begins with a corner, beside an arc, that is so small that it counts as
/// none.
bool follows_almost_straight_arc(const std::string& text, int line);

}  // namespace lockstep::oracle
