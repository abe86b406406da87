// Injects clock error for tests.
#pragma once

#include <chrono>
#include <expected>
#include <string>
#include <string_view>

namespace lockstep {

struct ClockError {
    double offset_s = 0;
    double ppm = 0;        // rate error; positive: the clock runs fast
    double step_s = 0;     // the clock is set forward by this ...
    double step_at_s = 0;  // ... this long after its start

    bool operator==(const ClockError&) const = default;

    /// Returns the reading of the wrong clock when a correct clock reads `time`. `since` is the time since the clock's
    /// start.
    std::chrono::nanoseconds applied(std::chrono::nanoseconds time, std::chrono::nanoseconds since) const;
};

/// Parses "offset=SECONDS,ppm=N,step=SECONDS@SECONDS". All parts are optional. Error: the part that cannot be read.
std::expected<ClockError, std::string> parse_clock_error(std::string_view text);

}  // namespace lockstep
