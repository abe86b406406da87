#include "clients/analysis/record_state.hpp"

#include <fmt/format.h>
#include <fmt/ranges.h>

#include "clients/text/numbers.hpp"

namespace lockstep::analysis {

std::string missing_between(const std::string& process, std::int64_t messages, const std::string& what) {
    return fmt::format("{}: {} of {}", process, plural(messages, "message"), what);
}

RecordState record_state(const Analysis& analysis) {
    RecordState state{.missing = missing_sentences(analysis.end), .not_known = open_sentences(analysis.end)};
    const auto note = [&](const std::string& process, std::int64_t messages, const char* what) {
        if (messages > 0) { state.missing.push_back(missing_between(process, messages, what)); }
    };
    for (const auto& axis : analysis.axes) {
        const std::string process = "axis " + axis->name();
        note(process, axis->statistics().missing_batches(), "steps");
        note(process, axis->missing_positions(), "positions");
        note(process, axis->missing_figures(), "figures");
    }
    note("coordinator", analysis.missing_job_events, "jobs");
    return state;
}

std::string to_text(const RecordState& state) {
    if (!state.is_complete()) { return fmt::format("missing: {}", fmt::join(state.missing, "; ")); }
    if (state.not_known.empty()) { return "complete: no message of the record is missing"; }
    return fmt::format("complete as far as is known: {}", fmt::join(state.not_known, "; "));
}

}  // namespace lockstep::analysis
