// The intended differences between rs274 and our interpreter, each with its exact condition.
#pragma once

#include <string>
#include <vector>

#include "tests/integration/oracle/rs274.hpp"

namespace lockstep::oracle {

/// Whether the list allows that only one of the two refuses a line, after both did the same up to this line.
bool may_refuse_alone(const std::string& text, const Reading& theirs, const Reading& ours);

/// Whether the list allows different motions from call `index` on.
bool may_move_apart(const std::string& text, const std::vector<Call>& theirs, const std::vector<Call>& ours,
                    std::size_t index);

std::string line_of(const std::string& text, int number);

}  // namespace lockstep::oracle
