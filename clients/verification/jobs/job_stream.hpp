// Delivers the records of jobs and of events of programs in the order of their numbers, for each coordinator. Records
// may come late, twice or never.
//
// A log may begin later than its coordinator. Then no record is missing before the first one.
#pragma once

#include <cstddef>
#include <cstdint>
#include <functional>
#include <lockstep/program_event_t.hpp>
#include <map>
#include <optional>
#include <variant>

#include "services/record/reading/content_memory.hpp"
#include "services/record/reading/program_parts.hpp"

namespace lockstep::verification {

using JobRecord = std::variant<analysis::RecordedJob, program_event_t>;

class JobStream {
public:
    /// How many records of a coordinator wait for a missing one before it is given up, and how long, in microseconds of
    /// machine time.
    static constexpr std::size_t kPatience = 16;
    static constexpr std::int64_t kPatience_us = 500'000;
    /// If a coordinator's first record in the log has a number up to this, records of lower numbers may still follow.
    static constexpr std::int64_t kShuffled = 8;

    /// `is_behind_gap`: records of this coordinator before this one are missing.
    using OnRecord = std::function<void(const JobRecord& record, bool is_behind_gap)>;
    /// An earlier record has the number of this one, but other content.
    using OnOther = std::function<void(const JobRecord& record)>;

    JobStream(OnRecord on_record, OnOther on_other)
        : on_record_(std::move(on_record)), on_other_(std::move(on_other)) {}

    void take(JobRecord record);
    /// The log has reached this time of the machine.
    void pass(std::int64_t utime);
    /// Delivers the waiting records. Call once, at the end of the log.
    void finish();

private:
    struct Coordinator {
        std::int64_t expected = 0;
        bool has_begun = false;  // a record was delivered
        std::map<std::int64_t, JobRecord> waiting;
    };
    void deliver(Coordinator& of, std::size_t patience, std::optional<std::int64_t> newest_us);

    OnRecord on_record_;
    OnOther on_other_;
    std::map<std::int64_t, Coordinator> coordinators_;
    analysis::ContentMemory contents_;
    std::size_t waiting_ = 0;
};

}  // namespace lockstep::verification
