// LinuxCNC's interpreter as a program: /usr/bin/rs274 of Debian's linuxcnc-uspace.
#pragma once

#include <string>
#include <vector>

#include "core/gcode/state.hpp"
#include "tests/integration/oracle/canonical.hpp"

namespace lockstep::oracle {

struct Reading {
    std::vector<Call> calls;  // to the refused line, or to the program's end
    bool taken = false;
    std::string message;  // rs274's, where it refused the program; ours else
    std::string refused;  // the text of the refused line
    int line = 0;         // of it, where known
    bool ended = true;    // rs274 loops for ever in some programs that end
};

bool is_rs274_installed();

/// The tools that both interpreters have.
std::map<int, gcode::Tool> tools();

/// Runs rs274 on the text in a directory of its own.
Reading read_with_rs274(const std::string& text);
Reading read_with_ours(const std::string& text);

}  // namespace lockstep::oracle
