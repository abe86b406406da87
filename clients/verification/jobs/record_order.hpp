// The records of jobs that are not handled yet, in the order in which they happened.
//
// A stopped coordinator may publish late records of its job after another coordinator has begun one. They are sorted
// before that job.
#pragma once

#include <cstdint>
#include <deque>
#include <optional>
#include <utility>

#include "core/protocol/messages.hpp"
#include "services/record/reading/program_parts.hpp"

namespace lockstep::verification {

using analysis::RecordedJob;

struct OrderedRecord : RecordedJob {
    bool is_behind_gap = false;  // records of the coordinator before it are missing
    bool is_of_event = false;    // no record of the job: it only marks the gap before an event
};

class RecordOrder {
public:
    void add(OrderedRecord record);
    bool empty() const { return records_.empty(); }
    const OrderedRecord& front() const { return records_.front(); }
    /// Removes the first record and returns it.
    OrderedRecord take();
    /// How many records must be handled to begin the epoch; nullopt if none begins it.
    std::optional<std::size_t> up_to_epoch(Epoch epoch) const;

    /// Whether a job has begun.
    bool has_job() const { return !begun_.empty(); }
    /// A record of a job by its coordinator, after another coordinator began a job.
    bool is_late(const RecordedJob& record) const;

private:
    static constexpr std::size_t kJobsKept = 16;

    std::deque<OrderedRecord> records_;
    std::deque<std::pair<std::int64_t, std::int64_t>> begun_;  // the newest jobs: coordinator and number
};

}  // namespace lockstep::verification
