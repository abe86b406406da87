// The way back to the place of a pause, for axes that were jogged in it: lift, across, down.
#pragma once

#include <cstdint>
#include <span>
#include <string>
#include <vector>

#include "core/machine.hpp"
#include "core/program.hpp"

namespace lockstep {

/// Returns the rapid moves from `here` to `place`, in steps, one number per axis of the machine. If the machine has an
/// axis Z, it first rises to the higher of the two places, then the other axes move together on a straight line, and Z
/// goes down last. Every move ends at rest. Moves of no length are left out.
Program return_way(const MachineConfig& machine, std::span<const std::int64_t> here,
                   std::span<const std::int64_t> place);

/// "Z to 20 mm, then X to 30 mm and Y to 5 mm, then Z to -1.5 mm". Empty if the axes are at the place.
std::string text_of_way(const Program& way);

}  // namespace lockstep
