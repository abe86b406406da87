// Whether a path of the tool's centre strays from the programmed path: found by distances and directions alone, without
// the rules of cutter compensation.
#pragma once

#include <string>

#include "tests/integration/oracle/rs274.hpp"

namespace lockstep::oracle {

/// At the line that we have refused, rs274's path comes nearer to the program's path than the tool's radius, runs
/// backward along it, or goes around an arc once more.
bool strays_from_path(const std::string& text, const Reading& theirs, const Reading& ours);

/// The motion of `line` begins or ends where the program's path turns back between an arc and another motion.
bool turns_back_at(const std::string& text, int line);

/// The motion before that of `line` is an arc, or follows one, that it begins with so small a corner that it counts as
/// none.
bool follows_almost_straight_arc(const std::string& text, int line);

}  // namespace lockstep::oracle
