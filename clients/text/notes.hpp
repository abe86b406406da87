// Warnings about a program's text.
#pragma once

#include <vector>

#include "clients/text/output.hpp"
#include "core/gcode/gcode.hpp"

namespace lockstep {

/// One warning for each note, with its line.
void warn_of(const std::vector<GcodeNote>& notes, Output& output);

}  // namespace lockstep
