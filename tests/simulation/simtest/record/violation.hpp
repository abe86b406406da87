// The report of a check.
#pragma once

#include <cstdint>
#include <iterator>
#include <optional>
#include <string>
#include <vector>

namespace lockstep::simtest {

struct Violation {
    std::string rule;  // "acceleration", "together", ...
    std::optional<std::size_t> axis;
    std::optional<std::int64_t> tick;
    std::optional<std::size_t> step;  // of the axis, counted from power-up
    std::string text;
};

using Violations = std::vector<Violation>;

inline void append(Violations& to, Violations from) {
    to.insert(to.end(), std::make_move_iterator(from.begin()), std::make_move_iterator(from.end()));
}

}  // namespace lockstep::simtest
