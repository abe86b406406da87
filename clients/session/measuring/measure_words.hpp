// Reads the words of a measurement: ways such as X=10 and ranges such as X=10:190. Pure.
#pragma once

#include <array>
#include <cstddef>
#include <expected>
#include <string>
#include <vector>

namespace lockstep {

/// A way along X or Y, from where the axis stands.
struct Way {
    std::size_t axis = 0;  // 0: X, 1: Y
    double mm = 0;         // not 0
};

struct Range {
    double from_mm = 0;
    double to_mm = 0;  // above from_mm
};

/// Exactly one word, "X=10" or "Y=-10".
std::expected<Way, std::string> one_way(const std::vector<std::string>& words);
/// A word for X and one for Y.
std::expected<std::array<double, 2>, std::string> both_ways(const std::vector<std::string>& words);
/// A range for X and one for Y.
std::expected<std::array<Range, 2>, std::string> both_ranges(const std::vector<std::string>& words);

/// Error: the option's name, its value and its range with the unit.
std::expected<void, std::string> check_range(const std::string& option, double value, double least, double most,
                                             const std::string& unit);

}  // namespace lockstep
