// Whether rs274 and our interpreter do the same, except for the listed differences.
#pragma once

#include <string>
#include <vector>

#include "tests/integration/oracle/rs274.hpp"

namespace lockstep::oracle {

struct Difference {
    std::string text;  // empty: none
    bool is_listed = false;
};

/// The first call that differs, up to the end of the shorter list: a refused line may have acted before its error.
Difference difference_of_calls(const std::string& text, const std::vector<Call>& theirs, const std::vector<Call>& ours);

/// The first difference. Empty if the two agree in every call, in what they refuse, and in the parameters that they
/// leave.
std::string compare(const std::string& text, const Reading& theirs, const Reading& ours);

}  // namespace lockstep::oracle
