#include "clients/verification/steps/pulse_check.hpp"

#include <utility>

namespace lockstep::verification {

using Kind = ChannelEvent::Kind;

/// A step that arrives at a place in the tick of a change was before it.
std::optional<std::vector<ChannelEvent>> PulseCheck::events_of(const Part& part) {
    const analysis::Run& run = part.run;
    if (run.frame == 1 && !run.tail) {
        places_ = {};
        is_known_ = true;
        left_.reset();
    }
    if (!is_known_) { return std::nullopt; }
    std::vector<ChannelEvent> events;
    analysis::StepMaker steps(run);
    const auto count = [&] { return steps.count() + run.zero_count; };
    const auto pass_until = [&](Tick tick) {
        while (steps.next() != nullptr && steps.next()->tick <= tick) {
            const Tick at = steps.next()->tick;
            steps.pass();
            arrive(at, count(), events);
        }
    };
    for (const OutputChange& change : part.changes) {
        const auto* places = std::get_if<ComparePosition>(&change.what);
        if (places == nullptr) { continue; }
        pass_until(run.start + change.at);
        begin({.next = places->next + run.zero_count, .every = places->every, .pulses = places->pulses},
              run.start + change.at, count(), events);
    }
    const Tick over = run.start + run.ticks();
    if (places_.pulses > 0) { pass_until(over); }
    if (left_) { left_ = places_.pulses; }
    if (part.is_last) {
        end(over, run.to().count() + run.zero_count, events);
        is_known_ = false;
    }
    return events;
}

void PulseCheck::begin(const ComparePosition& places, Tick tick, std::int64_t count,
                       std::vector<ChannelEvent>& events) {
    end(tick, count, events);
    places_ = places;
    left_ = places.pulses;
    if (places.pulses == 0) { return; }
    events.push_back({.tick = tick, .kind = Kind::CompareBegins, .value = count, .detail = places.pulses});
}

void PulseCheck::end(Tick tick, std::int64_t count, std::vector<ChannelEvent>& events) {
    const std::uint32_t left = std::exchange(places_.pulses, 0);
    if (left == 0) { return; }
    events.push_back({.tick = tick, .kind = Kind::CompareEnds, .value = count, .detail = left});
}

void PulseCheck::arrive(Tick tick, std::int64_t count, std::vector<ChannelEvent>& events) {
    if (places_.pulses == 0 || count != places_.next) { return; }
    places_.next += places_.every;
    if (--places_.pulses == 0) { events.push_back({.tick = tick, .kind = Kind::CompareEnds, .value = count}); }
}

}  // namespace lockstep::verification
