#include "clients/verification/events/recorded_events.hpp"

#include <algorithm>

namespace lockstep::verification {

void RecordedEvents::begin(std::int64_t job, std::int64_t coordinator) {
    if (job != job_ || std::ranges::find(coordinators_, coordinator) == coordinators_.end()) { end(); }
    job_ = job;
    coordinators_ = {coordinator};
}

void RecordedEvents::end() {
    for (const std::int64_t coordinator : coordinators_) { waiting_.erase({job_, coordinator}); }
    coordinators_.clear();
}

const program_event_t* RecordedEvents::next() const {
    for (const std::int64_t coordinator : coordinators_) {
        const auto found = waiting_.find({job_, coordinator});
        if (found != waiting_.end() && !found->second.empty()) { return &found->second.front(); }
    }
    return nullptr;
}

void RecordedEvents::pop() {
    const program_event_t* event = next();
    waiting_.find({event->job, event->coordinator})->second.pop_front();
}

std::vector<program_event_t> RecordedEvents::take_later_ends(std::int64_t job) {
    std::vector<program_event_t> ends;
    for (auto& [whose, events] : waiting_) {
        if (whose.first >= job) { break; }
        std::ranges::copy_if(events, std::back_inserter(ends), [](const auto& event) { return event.of_program == 0; });
        std::erase_if(events, [](const program_event_t& event) { return event.of_program == 0; });
    }
    return ends;
}

const program_event_t* RecordedEvents::left_of(std::int64_t coordinator) const {
    for (const auto& [whose, events] : waiting_) {
        const auto left = std::ranges::find_if(events, [](const auto& event) { return event.of_program != 0; });
        if (left != events.end() && left->coordinator == coordinator) { return &*left; }
    }
    return nullptr;
}

}  // namespace lockstep::verification
