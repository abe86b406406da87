// Sets of a machine's axes.
#pragma once

#include <cstddef>
#include <cstdint>

namespace lockstep {

inline constexpr std::size_t kMaxAxes = 64;

/// Axes of a machine: bit i for the axis in place i of the configuration.
using AxisSet = std::uint64_t;
constexpr AxisSet axis_bit(std::size_t axis) { return AxisSet{1} << axis; }
constexpr bool has_axis(AxisSet axes, std::size_t axis) { return (axes >> axis & 1) != 0; }
constexpr AxisSet all_axes(std::size_t count) { return count == 0 ? 0 : ~AxisSet{0} >> (kMaxAxes - count); }

}  // namespace lockstep
