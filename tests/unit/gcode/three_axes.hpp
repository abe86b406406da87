// A machine for the examples here: X and Y of 200 mm and Z of 60 mm, at 0, parked at 5.
#pragma once

#include "core/gcode/gcode.hpp"

namespace lockstep {

inline GcodeSetup three_axes() {
    return {.program_name = "example",
            .axes = {{.name = "X", .min_mm = 0, .max_mm = 200, .park_mm = 5, .start_mm = 0},
                     {.name = "Y", .min_mm = 0, .max_mm = 200, .park_mm = 5, .start_mm = 0},
                     {.name = "Z", .min_mm = 0, .max_mm = 60, .park_mm = 5, .start_mm = 0}}};
}

}  // namespace lockstep
