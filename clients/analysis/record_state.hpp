// Whether the record in a log is complete, as text about missing and unknown parts, and for the steps of one job.
#pragma once

#include <string>
#include <vector>

#include "clients/analysis/analysis.hpp"

namespace lockstep::analysis {

struct RecordState {
    std::vector<std::string> missing;
    std::vector<std::string> not_known;  // until when the record is known to be complete; empty if to its end

    bool is_complete() const { return missing.empty(); }
};

/// "axis X: 3 messages of steps": missing between the first and the last message in the log.
std::string missing_between(const std::string& process, std::int64_t messages, const std::string& what);

RecordState record_state(const Analysis& analysis);

/// "complete: ...", "complete as far as is known: ...", or "missing: ...".
std::string to_text(const RecordState& state);

/// Whether the log has all steps that the axis made during the job. Returns false if the log lacks steps of the axis
/// within the job, if it ends before the job, or if a part of it that cannot be read may have contained them.
bool has_all_steps_of(const Analysis& analysis, const JobLog& job, const std::string& axis);

}  // namespace lockstep::analysis
