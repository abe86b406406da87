// The labels of the branches and loops that were run. Each subroutine has labels of its own.
#pragma once

#include <cstddef>
#include <map>
#include <optional>
#include <string>
#include <utility>

#include "core/gcode/flow/o_word.hpp"

namespace lockstep::gcode {

class UsedLabels {
public:
    explicit UsedLabels(std::size_t most) : most_(most) {}

    /// Notes that the O-word in this line opens a branch or a loop. A label opens one thing only, of those that run.
    /// A do loop may open the label of another do loop again.
    std::optional<GcodeError> open(std::string subroutine, const OWord& word, const Line& line);

private:
    struct Opening {
        Keyword keyword;
        int line;
    };

    std::size_t most_;
    std::map<std::pair<std::string, std::string>, Opening> openings_;  // by subroutine and label
};

}  // namespace lockstep::gcode
