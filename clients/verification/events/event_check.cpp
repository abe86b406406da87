#include "clients/verification/events/event_check.hpp"

#include <fmt/format.h>

#include <algorithm>

#include "clients/verification/jobs/record_text.hpp"
#include "services/wire/lcm/translate_lcm.hpp"

namespace lockstep::verification {
namespace {

std::string text_of(const ProgramEvent& event) {
    return verification::text_of(name_of(event.kind), event.index, event.value);
}

std::string place_of(const PathEvent& event) { return verification::place_of(event.line.value_or(0), event.block); }

}  // namespace

void EventCheck::begin(std::int64_t coordinator, std::int64_t job, const std::string& label,
                       std::shared_ptr<const analysis::RecordedProgram> program) {
    recorded_.begin(job, coordinator);
    if (epoch_coordinator_ != 0 && epoch_coordinator_ != coordinator) { devices_.lose(); }
    for (const program_event_t& end : recorded_.take_later_ends(job)) {
        if (const auto switched = event_of(end)) { devices_.apply(*switched); }
    }
    findings_.job = label;
    planned_.begin(std::move(program));
    begin_epoch(0, coordinator);
}

void EventCheck::begin_epoch(Epoch epoch, std::int64_t coordinator) {
    findings_.epoch = epoch;
    epoch_coordinator_ = coordinator;
}

/// Skips events that were published again: the earlier coordinator published them but ended before it reported that.
void EventCheck::skip_repeats() {
    while (recorded_.was_taken_over()) {
        const program_event_t* event = recorded_.next();
        const bool is_repeat = event != nullptr && !recorded_.is_of_first(*event) && event->of_program != 0 &&
                               event->block < planned_.from();
        if (!is_repeat) { return; }
        findings_.all.notes.push_back(
            fmt::format("{}: the event of {} was published again after a takeover", findings_.job, place_of(*event)));
        recorded_.pop();
    }
}

bool EventCheck::is_the_same(const program_event_t& recorded, const PathEvent& planned) {
    const ProgramEvent& event = planned.event;
    const bool is_same = recorded.kind == name_of(event.kind) && recorded.index == event.index &&
                         recorded.value == event.value && recorded.line == planned.line.value_or(0);
    return is_same || findings_.differ(fmt::format("the event of {} is recorded as {} of line {}; its program has {}",
                                                   place_of(planned), text_of(recorded), recorded.line, text_of(event)),
                                       planned.line.value_or(0), {}, Tick{recorded.tick});
}

/// An event with a place in motion may be published at rest only if the axes came to rest before its tick by the
/// coordinator's clock, or by an owner that took over.
bool EventCheck::is_in_time(const program_event_t& recorded, Tick planned) {
    const Tick seen{recorded.tick};
    if (recorded.at_rest != 0 && (is_heirs(recorded) || seen < planned)) { return true; }
    const std::string event = "the event of " + place_of(recorded);
    if (recorded.at_rest != 0) {
        return findings_.differ(event + " is recorded at rest; its place is in motion", recorded.line, planned, seen);
    }
    if (static_cast<Epoch>(recorded.epoch) != findings_.epoch) {
        return findings_.differ(
            fmt::format("{} is recorded in epoch {}; planned: epoch {}", event, recorded.epoch, findings_.epoch),
            recorded.line, planned, seen);
    }
    return seen == planned ||
           findings_.differ(event + " is recorded at another tick than planned", recorded.line, planned, seen);
}

bool EventCheck::is_of_rest(const program_event_t& recorded) {
    const std::string event = "the event of " + place_of(recorded);
    if (recorded.at_rest == 0) {
        return findings_.differ(event + " is recorded in motion, where the axes rest", recorded.line, {},
                                Tick{recorded.tick});
    }
    const bool is_later = static_cast<Epoch>(recorded.epoch) >= findings_.epoch || recorded_.was_taken_over();
    return is_later || findings_.differ(fmt::format("{} is recorded in epoch {}, before epoch {}, to which it belongs",
                                                    event, recorded.epoch, findings_.epoch),
                                        recorded.line, {}, Tick{recorded.tick});
}

/// Returns true if the record is known to be incomplete there; the event is then left out.
bool EventCheck::lacks(const PathEvent& planned) {
    const std::string event =
        findings_.job + ": the event of " + place_of(planned) + ", " + text_of(planned.event) + ",";
    if (recorded_.was_taken_over()) {
        findings_.all.add_unknown(event + " is not in the log; its coordinator may have ended before it was recorded");
        devices_.lose();
        planned_.pass();
        return true;
    }
    const program_event_t* there = recorded_.next();
    const bool is_other = there != nullptr && there->of_program != 0;
    return findings_.differ(event + " is not in the log" + (is_other ? ", which has that of " + place_of(*there) : ""),
                            planned.line.value_or(0), {}, is_other ? std::optional(Tick{there->tick}) : std::nullopt);
}

void EventCheck::note(const PathEvent& event) {
    devices_.apply(event.event);
    recorded_.pop();
    planned_.pass();
    ++findings_.all.events;
}

void EventCheck::check_motion(std::span<const EpochRunner::Happened> planned, bool may_end_early) {
    for (const auto& [tick, event] : planned) {
        if (!findings_.all.going()) { return; }
        if (planned_.is_done() || event.block < planned_.block()) { continue; }  // published at an earlier rest
        skip_repeats();
        while (!planned_.is_done() && planned_.block() < event.block) {
            if (!lacks(planned_.next())) { return; }
        }
        const program_event_t* there = recorded_.next();
        if (there == nullptr && may_end_early) { return; }
        if (there == nullptr || there->of_program == 0 || there->block != event.block) {
            if (may_end_early && there != nullptr && there->of_program == 0) { return; }
            if (!lacks(event)) { return; }
            continue;
        }
        if (!is_the_same(*there, event) || !is_in_time(*there, tick)) { return; }
        note(event);
    }
}

void EventCheck::check_rest(std::uint32_t must, std::uint32_t may) {
    while (findings_.all.going() && !planned_.is_done() && planned_.block() < may) {
        const PathEvent planned = planned_.next();
        skip_repeats();
        const program_event_t* there = recorded_.next();
        const bool is_it = there != nullptr && there->of_program != 0 && there->block == planned.block;
        if (!is_it) {
            if (planned.block >= must || !lacks(planned)) { return; }
            continue;
        }
        if (planned.block >= must && there->at_rest == 0) { return; }
        if (!is_the_same(*there, planned) || !is_of_rest(*there)) { return; }
        note(planned);
    }
}

void EventCheck::leave() {
    recorded_.end();
    planned_.begin(nullptr);
    devices_.lose();
}

void EventCheck::end(JobOutcome outcome) {
    const bool is_done = outcome == JobOutcome::Done;
    if (!findings_.all.going() || !recorded_.has_job()) { return; }
    skip_repeats();
    const program_event_t* there = recorded_.next();
    if (there != nullptr && (is_done || there->of_program != 0)) {
        (void)findings_.differ(fmt::format("an event of {}, {}, is recorded, which its program does not have there",
                                           place_of(*there), text_of(*there)),
                               there->line, {}, Tick{there->tick});
        return;
    }
    if (!is_done) { switched_off_.check(outcome); }
    recorded_.end();
}

void EventCheck::finish() {
    const program_event_t* const left = recorded_.left_of(epoch_coordinator_);
    if (left == nullptr) { return; }
    findings_.job = fmt::format("job {}", left->job);
    (void)findings_.differ(
        fmt::format("an event of {}, {}, is recorded, but its job is not in progress", place_of(*left), text_of(*left)),
        left->line, {}, Tick{left->tick});
}

}  // namespace lockstep::verification
