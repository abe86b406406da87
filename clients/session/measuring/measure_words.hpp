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

/// Why something cannot be measured.
struct MeasureError {
    std::string option;  // whose value is wrong, such as feed; empty if it is none of them
    std::string text;    // "is 0; it must be from 1 to 5 mm", or without an option a sentence
};

/// "--feed is 0; it must be from 1 to 5 mm/min": as an option of a command.
std::string text_of(const MeasureError& error);

/// Exactly one word, "X=10" or "Y=-10".
std::expected<Way, std::string> one_way(const std::vector<std::string>& words);
/// A word for X and one for Y.
std::expected<std::array<double, 2>, std::string> both_ways(const std::vector<std::string>& words);
/// A range for X and one for Y.
std::expected<std::array<Range, 2>, std::string> both_ranges(const std::vector<std::string>& words);

/// Error: the option, its value and its range with the unit.
std::expected<void, MeasureError> check_range(const std::string& option, double value, double least, double most,
                                              const std::string& unit);

}  // namespace lockstep
