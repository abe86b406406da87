// Measures with a probe: makes the program, runs it, prints the result, and sets what the person asked to be set.
#pragma once

#include <string>

#include "clients/lockstep/live_options.hpp"
#include "clients/session/measuring/measuring_program.hpp"
#include "clients/text/exit_code.hpp"

namespace lockstep {

struct MeasureVerbOptions : LiveOptions {
    MeasureOptions measure;
    std::string set;  // the coordinate system whose zero, or rotation, becomes the result; empty: none
    int tool = 0;     // whose length becomes the result; 0: none
    std::string csv;  // the file of a surface's points; empty: none
};

ExitCode run_measurement(const MeasureVerbOptions& options);

}  // namespace lockstep
