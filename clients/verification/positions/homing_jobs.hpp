// When a machine homed, by the records of its jobs.
#pragma once

#include <algorithm>
#include <cstdint>
#include <limits>
#include <map>
#include <utility>

#include "services/record/reading/program_parts.hpp"

namespace lockstep::verification {

class HomingJobs {
public:
    /// Records of jobs may come late, twice or never.
    void take(const analysis::RecordedJob& record) {
        if (record.kind != "home") { return; }
        Span& span = spans_[{record.coordinator, record.job}];
        if (record.event == "begun") { span.from_us = record.utime; }
        if (record.event == "ended") { span.to_us = record.utime; }
    }
    /// Whether the machine homed at some time from `from_us` to `to_us`, microseconds of machine time.
    bool any_in(std::int64_t from_us, std::int64_t to_us) const {
        return std::ranges::any_of(spans_, [&](const auto& homing) {
            return homing.second.from_us <= to_us && from_us <= homing.second.to_us;
        });
    }

private:
    struct Span {
        std::int64_t from_us = std::numeric_limits<std::int64_t>::min();
        std::int64_t to_us = std::numeric_limits<std::int64_t>::max();
    };
    std::map<std::pair<std::int64_t, std::int64_t>, Span> spans_;  // by coordinator and job
};

}  // namespace lockstep::verification
