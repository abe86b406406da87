// The unit of an axis's places: mm, or degrees if it is rotary. The keys of the machine's file say mm for both.
#pragma once

#include <string_view>

namespace lockstep {

/// Decides by the name, as G-code does: A, B and C turn about X, Y and Z.
constexpr bool is_rotary(std::string_view axis) {
    return axis.size() == 1 && std::string_view("ABCabc").contains(axis.front());
}

constexpr std::string_view unit_of(std::string_view axis) { return is_rotary(axis) ? "deg" : "mm"; }

}  // namespace lockstep
