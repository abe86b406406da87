// What is wrong with a G-code text, and where.
#pragma once

#include <string>

namespace lockstep {

struct GcodeError {
    int line = 0;          // from 1
    int column = 0;        // from 1, in bytes
    std::string message;   // the value, the limit and the remedy
    bool repeats = false;  // lines behind it are wrong for the same reason: once is enough
    bool operator==(const GcodeError&) const = default;
};

}  // namespace lockstep
