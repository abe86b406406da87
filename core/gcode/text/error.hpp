// An error in a G-code text.
#pragma once

#include <expected>
#include <string>

namespace lockstep {

struct GcodeError {
    int line = 0;          // from 1
    int column = 0;        // from 1, in bytes
    std::string message;   // the value, the limit and the remedy
    bool repeats = false;  // later lines have the same error; it is reported once
    bool operator==(const GcodeError&) const = default;
};

namespace gcode {

using Result = std::expected<void, GcodeError>;

}  // namespace gcode

}  // namespace lockstep
