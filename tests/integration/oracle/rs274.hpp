// LinuxCNC's interpreter as a program: /usr/bin/rs274 of Debian's linuxcnc-uspace.
#pragma once

#include <map>
#include <string>
#include <vector>

#include "core/gcode/state.hpp"
#include "tests/integration/oracle/canonical.hpp"

namespace lockstep::oracle {

struct Reading {
    std::vector<Call> calls;  // to the refused line, or to the program's end
    bool taken = false;
    std::string message;         // the error message, if the program was refused
    std::string refused;         // the text of the refused line
    int line = 0;                // the number of that line, if known
    bool ended = true;           // false: rs274 did not end; it loops forever in some programs
    std::map<int, double> kept;  // parameters that outlive the program, in mm and degrees
};

bool is_rs274_installed();

/// The tools that both interpreters have.
std::map<int, gcode::Tool> tools();

/// Runs rs274 on the text, with files in a separate directory. `folder` has the subroutines that the text calls.
Reading read_with_rs274(const std::string& text, const std::string& folder = ".");
Reading read_with_ours(const std::string& text, const std::string& folder = ".");

/// The motions and dwells of each text with all digits, from rs274's interpreter as a library. It crashes at texts that
/// use the tool table, and it cuts splines into straight moves.
std::vector<std::vector<Call>> motions_with_all_digits(const std::vector<std::string>& texts);

}  // namespace lockstep::oracle
