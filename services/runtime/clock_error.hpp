// Injects clock error for tests.
#pragma once

#include <chrono>
#include <expected>
#include <string>
#include <string_view>

namespace lockstep {

struct ClockError {
    double offset_s = 0;
    double ppm = 0;        // fast
    double step_s = 0;     // set forward by this...
    double step_at_s = 0;  // ...so long after the clock's start

    bool operator==(const ClockError&) const = default;

    /// The reading of the wrong clock, `since` its start, when a correct one reads `time`.
    std::chrono::nanoseconds applied(std::chrono::nanoseconds time, std::chrono::nanoseconds since) const;
};

/// From "offset=SECONDS,ppm=N,step=SECONDS@SECONDS", each part once and all optional. Error: what cannot be read.
std::expected<ClockError, std::string> parse_clock_error(std::string_view text);

}  // namespace lockstep
