// When the jobs of a record began and ended.
#pragma once

#include <cstdint>
#include <string>
#include <vector>

#include "tests/records/record.hpp"

namespace lockstep::records {

struct RecordedSpan {
    std::int64_t job = 0;
    std::string kind;  // home, move, run, own-move, jog
    std::int64_t begin_us = 0;
    std::int64_t end_us = 0;  // of the last message if the job has no end
    std::int64_t middle_us() const { return begin_us + (end_us - begin_us) / 2; }
    bool contains(std::int64_t utime) const { return utime > begin_us && utime < end_us; }
};

/// In the order of their beginnings. Homing counts as a job.
std::vector<RecordedSpan> job_spans(const Record& record);
/// The first job of the kind; throws std::runtime_error without one.
RecordedSpan first_span(const Record& record, const std::string& kind);

}  // namespace lockstep::records
