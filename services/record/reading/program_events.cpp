#include "services/record/reading/program_events.hpp"

#include <algorithm>
#include <span>

namespace lockstep::analysis {

void ProgramEventLog::begin(const job_t& job, const RecordedProgram& program) {
    job_ = static_cast<std::uint64_t>(job.job);
    const auto is_of_it = [&](const HappenedEvent& event) {
        return event.job == *job_ && event.coordinator == job.coordinator;
    };
    const auto first = std::find_if_not(events_.rbegin(), events_.rend(), is_of_it).base();
    const auto before = static_cast<std::size_t>(events_.end() - first);
    note_places(program, before + (kEventsKept - events_.size()));
    std::for_each(first, events_.end(), [this](HappenedEvent& event) { find_place(event); });
}

void ProgramEventLog::end(const job_t& job) {
    if (job_ != static_cast<std::uint64_t>(job.job)) { return; }
    job_.reset();
    places_.clear();
}

/// The place of an event is the end of the move before it. Events happen in the order of the program, so the first
/// `at_most` places are sufficient.
void ProgramEventLog::note_places(const RecordedProgram& program, std::size_t at_most) {
    places_.clear();
    const std::vector<std::string>& axes = program.axes();
    for (const std::uint32_t block : std::span(program.events()).first(std::min(at_most, program.events().size()))) {
        const auto at_mm = program.place_before(block);
        if (!at_mm) { return; }
        ProgramPlace& place = places_[block];
        for (std::size_t i = 0; i < std::min(axes.size(), at_mm->size()); ++i) {
            place.emplace_back(axes[i], (*at_mm)[i]);
        }
    }
}

void ProgramEventLog::find_place(HappenedEvent& event) const {
    const auto place = event.is_of_program && event.job == job_ ? places_.find(event.block) : places_.end();
    event.place = place == places_.end() ? ProgramPlace{} : place->second;
}

void ProgramEventLog::take(const program_event_t& message, const ProgramEvent& event) {
    if (events_.size() == kEventsKept) {
        ++not_kept_;
        return;
    }
    HappenedEvent happened{.at = Tick{message.tick},
                           .event = event,
                           .coordinator = message.coordinator,
                           .job = static_cast<std::uint64_t>(message.job),
                           .block = message.block,
                           .line = {},
                           .at_rest = message.at_rest != 0,
                           .is_of_program = message.of_program != 0,
                           .place = {}};
    if (message.line > 0) { happened.line = message.line; }
    find_place(happened);
    events_.push_back(std::move(happened));
}

}  // namespace lockstep::analysis
