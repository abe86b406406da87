#include "clients/lockstep/job/event_lines.hpp"

#include <fmt/format.h>

#include "clients/text/event_text.hpp"
#include "core/number_text.hpp"

namespace lockstep {
namespace {

std::string line_of(const PublishedEvent& event) {
    return line_label(event.line) + event_text(event.event) + (event.is_of_program ? "" : ", at the job's end");
}

/// The number of events missing between the two; 0 if they are of different coordinators.
std::uint64_t missing_between(const PublishedEvent& before, const PublishedEvent& event) {
    const bool follows = before.term == event.term && event.sequence > before.sequence;
    return follows ? event.sequence - before.sequence - 1 : 0;
}

}  // namespace

std::vector<std::string> EventLines::of(std::span<const PublishedEvent> events) {
    std::vector<std::string> lines;
    for (const PublishedEvent& event : events) {
        const std::uint64_t missing = last_ ? missing_between(*last_, event) : 0;
        if (missing > 0) { lines.push_back(plural(static_cast<std::int64_t>(missing), "event") + " not received"); }
        if (event.job == job_) { lines.push_back(line_of(event)); }
        last_ = event;
    }
    return lines;
}

}  // namespace lockstep
