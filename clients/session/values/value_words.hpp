// Applies the words that change offsets and tools. Pure.
#pragma once

#include <expected>
#include <string>
#include <string_view>
#include <vector>

#include "core/gcode/kept_values.hpp"
#include "core/machine.hpp"

namespace lockstep {

/// The words of a change: "X=10", "R=30".
using ChangeWords = std::vector<std::string>;
using Changed = std::expected<void, std::string>;

/// `name`: G54 to G59.3, G92, G28 or G30. `words`: the machine's axes, and R, the rotation of a coordinate system. Axes
/// without a word keep their values. The error says what is wrong.
Changed set_offset(const MachineConfig& machine, std::string_view name, const ChangeWords& words,
                   gcode::KeptValues& values);
/// `name`: a coordinate system. `words`: the coordinates that the axes get in it at their present position `places_mm`.
/// G92 and a rotation keep their effect (G10 L20).
Changed touch_off(const MachineConfig& machine, const std::vector<double>& places_mm, std::string_view name,
                  const ChangeWords& words, gcode::KeptValues& values);
/// Sets an offset to the machine's zero, and G28 and G30 to the park position. "all" clears all of them.
Changed clear_offset(std::string_view name, gcode::KeptValues& values);

/// `words`: the machine's axes for the offset, D (diameter), P (pocket), Q (orientation of a lathe tool).
Changed set_tool(const MachineConfig& machine, int number, const ChangeWords& words, gcode::KeptValues& values);
Changed remove_tool(int number, gcode::KeptValues& values);

}  // namespace lockstep
