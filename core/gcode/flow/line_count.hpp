// The count of lines that loops and subroutines run. A loop that does not end exceeds its limits.
#pragma once

#include <cstdint>
#include <optional>
#include <string>

#include "core/gcode/setup.hpp"

namespace lockstep::gcode {

class LineCount {
public:
    explicit LineCount(const Limits& limits) : limits_(limits) {}

    /// Counts a line. Returns what is wrong if that is one too many.
    std::optional<std::string> add_line() {
        if (++idle_lines_ > limits_.idle_lines) {
            return "loops and subroutines ran " + std::to_string(limits_.idle_lines) +
                   " lines without a motion or an event; check that each loop ends";
        }
        if (++lines_ <= limits_.repeated_lines) { return std::nullopt; }
        return "loops and subroutines ran more than " + std::to_string(limits_.repeated_lines) +
               " lines; check that each loop ends";
    }
    /// An action within a body counts as a line.
    void add_action(bool is_within_body) {
        idle_lines_ = 0;
        lines_ += is_within_body ? 1 : 0;
    }

private:
    const Limits& limits_;
    std::int64_t lines_ = 0;       // and actions
    std::int64_t idle_lines_ = 0;  // since the last action
};

}  // namespace lockstep::gcode
