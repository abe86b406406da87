// The tick marks of an axis: multiples of 1, 2 or 5 times a power of ten, with the digits they need.
#pragma once

#include <string>
#include <vector>

namespace lockstep::drawing {

struct Range {
    double low = 0;
    double high = 1;
    double span() const { return high - low; }
    double middle() const { return low + span() / 2; }
    bool operator==(const Range&) const = default;
};

struct AxisTick {
    double value = 0;
    std::string label;  // "−0.25", "20 000"
};

/// About `wanted` marks within the range, never more than 2 * wanted + 2. Requires range.low < range.high.
std::vector<AxisTick> round_ticks(Range range, int wanted);

}  // namespace lockstep::drawing
