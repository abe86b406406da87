// Offsets and tools as a person reads them, and the words that change them. Pure.
#pragma once

#include <expected>
#include <string>
#include <string_view>
#include <vector>

#include "core/gcode/kept_values.hpp"
#include "core/machine.hpp"

namespace lockstep {

/// The coordinate systems that are set, G92, G28 and G30, a line each.
std::string offsets_text(const MachineConfig& machine, const gcode::KeptValues& values);
/// A line for each tool.
std::string tools_text(const MachineConfig& machine, const gcode::KeptValues& values);

/// "X=10", "R=30", a word of a change.
using ChangeWords = std::vector<std::string>;
using Changed = std::expected<void, std::string>;

/// `name`: G54 to G59.3, G92, G28 or G30; words: the machine's axes, and R, the rotation of a coordinate system. What
/// the words do not name stays. Error: what is wrong with it.
Changed set_offset(const MachineConfig& machine, std::string_view name, const ChangeWords& words,
                   gcode::KeptValues& values);
/// `name`: a coordinate system; words: what the machine's axes read in it from now on where they stand, `places_mm`.
/// G92 and a rotation keep their effect (G10 L20).
Changed touch_off(const MachineConfig& machine, const std::vector<double>& places_mm, std::string_view name,
                  const ChangeWords& words, gcode::KeptValues& values);
/// To the machine's zero; G28 and G30 to the park position. "all": every one.
Changed clear_offset(std::string_view name, gcode::KeptValues& values);

/// Words: the machine's axes for the offset, D (the diameter), P (the pocket), Q (the orientation of a lathe tool).
Changed set_tool(const MachineConfig& machine, int number, const ChangeWords& words, gcode::KeptValues& values);
Changed remove_tool(int number, gcode::KeptValues& values);

}  // namespace lockstep
