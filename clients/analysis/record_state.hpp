// Whether the record in a log is complete, as text about missing and unknown parts.
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

}  // namespace lockstep::analysis
