// Where rs274 and we differ on purpose, each with its exact condition.
#pragma once

#include <string>
#include <vector>

#include "tests/integration/oracle/rs274.hpp"

namespace lockstep::oracle {

/// Both have done the same up to the line that one of them refuses: whether the list allows that.
bool may_refuse_alone(const std::string& text, const Reading& theirs, const Reading& ours);

/// Whether the list allows different motions from call `index` on.
bool may_move_apart(const std::string& text, const std::vector<Call>& theirs, const std::vector<Call>& ours,
                    std::size_t index);

std::string line_of(const std::string& text, int number);

}  // namespace lockstep::oracle
