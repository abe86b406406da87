// The exported signals of each recorded message, for all formats. A signal's name ends with its unit.
#pragma once

#include <cstdint>
#include <lockstep/axis_health_t.hpp>
#include <lockstep/axis_position_t.hpp>
#include <lockstep/channel_event_t.hpp>
#include <lockstep/job_t.hpp>
#include <lockstep/program_event_t.hpp>
#include <string>
#include <string_view>
#include <variant>
#include <vector>

namespace lockstep::exporting {

using Value = std::variant<double, std::int64_t, std::string>;

struct Signal {
    std::string_view name;  // "position_mm"
    Value value;
};

/// The source of a sample: "/mill/X/position", "/mill/job".
using Topic = std::string;

/// All signals of a message, always the same ones in the same order.
struct Sample {
    Topic topic;
    std::int64_t utime = 0;  // microseconds of machine time
    std::vector<Signal> signals;
};

Sample sample_of(const axis_position_t& message);
Sample sample_of(const axis_health_t& message);
Sample sample_of(const channel_event_t& message);
Sample sample_of(const job_t& message);
Sample sample_of(const program_event_t& message);

}  // namespace lockstep::exporting
