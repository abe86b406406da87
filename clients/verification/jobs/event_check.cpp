#include "clients/verification/jobs/event_check.hpp"

#include <fmt/format.h>

#include <algorithm>

#include "core/outputs/output_levels.hpp"
#include "services/wire/lcm/translate_lcm.hpp"

namespace lockstep::verification {
namespace {

std::string text_of(std::string_view kind, std::int32_t index, double value) {
    return fmt::format("{} (index {}, value {:f})", kind, index, value);
}

std::string text_of(const program_event_t& event) { return text_of(event.kind, event.index, event.value); }

std::string text_of(const ProgramEvent& event) { return text_of(name_of(event.kind), event.index, event.value); }

std::string place_of(std::int32_t line, std::int64_t block) { return fmt::format("line {}, block {}", line, block); }

std::string place_of(const program_event_t& event) { return place_of(event.line, event.block); }

std::string place_of(const PathEvent& event) { return place_of(event.line.value_or(0), event.block); }

}  // namespace

void EventCheck::take(const program_event_t& event) { waiting_[{event.job, event.coordinator}].push_back(event); }

void EventCheck::begin(std::int64_t coordinator, std::int64_t job, const std::string& label,
                       std::shared_ptr<const analysis::RecordedProgram> program) {
    if (job != job_ || std::ranges::find(coordinators_, coordinator) == coordinators_.end()) { forget_job(); }
    if (epoch_coordinator_ != 0 && epoch_coordinator_ != coordinator) { knows_devices_ = false; }
    apply_later_ends(job);
    job_ = job;
    label_ = label;
    coordinators_ = {coordinator};
    epoch_coordinator_ = coordinator;
    epoch_ = 0;
    program_ = std::move(program);
    done_ = 0;
}

void EventCheck::begin_epoch(Epoch epoch, std::int64_t coordinator) {
    epoch_ = epoch;
    epoch_coordinator_ = coordinator;
}

const program_event_t* EventCheck::next() {
    for (const std::int64_t coordinator : coordinators_) {
        const auto found = waiting_.find({job_, coordinator});
        if (found != waiting_.end() && !found->second.empty()) { return &found->second.front(); }
    }
    return nullptr;
}

void EventCheck::pop() {
    const program_event_t* event = next();
    waiting_.find({event->job, event->coordinator})->second.pop_front();
}

PathEvent EventCheck::event_at(std::uint32_t block) const {
    const Block* its = program_->block(block);
    if (its == nullptr) { return {block, 0, {}}; }  // the log was altered: JobCheck reports it
    return {block, its->line, std::get<ProgramEvent>(its->action)};
}

/// Skips events that were published again: the earlier coordinator published them but ended before it reported that.
void EventCheck::skip_repeats() {
    const std::int64_t from = done_ == 0 ? 0 : program_->events()[done_ - 1] + 1;
    while (coordinators_.size() > 1) {
        const program_event_t* event = next();
        const bool is_repeat = event != nullptr && event->coordinator != coordinators_.front() &&
                               event->of_program != 0 && event->block < from;
        if (!is_repeat) { return; }
        findings_.notes.push_back(
            fmt::format("{}: the event of {} was published again after a takeover", label_, place_of(*event)));
        pop();
    }
}

bool EventCheck::is_the_same(const program_event_t& recorded, const PathEvent& planned) {
    const ProgramEvent& event = planned.event;
    const bool is_same = recorded.kind == name_of(event.kind) && recorded.index == event.index &&
                         recorded.value == event.value && recorded.line == planned.line.value_or(0);
    return is_same || differ(fmt::format("the event of {} is recorded as {} of line {}; its program has {}",
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
        return differ(event + " is recorded at rest; its place is in motion", recorded.line, planned, seen);
    }
    if (static_cast<Epoch>(recorded.epoch) != epoch_) {
        return differ(fmt::format("{} is recorded in epoch {}; planned: epoch {}", event, recorded.epoch, epoch_),
                      recorded.line, planned, seen);
    }
    return seen == planned || differ(event + " is recorded at another tick than planned", recorded.line, planned, seen);
}

bool EventCheck::is_of_rest(const program_event_t& recorded) {
    const std::string event = "the event of " + place_of(recorded);
    if (recorded.at_rest == 0) {
        return differ(event + " is recorded in motion, where the axes rest", recorded.line, {}, Tick{recorded.tick});
    }
    const bool is_later = static_cast<Epoch>(recorded.epoch) >= epoch_ || coordinators_.size() > 1;
    return is_later || differ(fmt::format("{} is recorded in epoch {}, before epoch {}, to which it belongs", event,
                                          recorded.epoch, epoch_),
                              recorded.line, {}, Tick{recorded.tick});
}

/// Returns true if the record is known to be incomplete there; the event is then left out.
bool EventCheck::lacks(const PathEvent& planned) {
    const std::string event = label_ + ": the event of " + place_of(planned) + ", " + text_of(planned.event) + ",";
    if (coordinators_.size() > 1) {
        findings_.add_unknown(event + " is not in the log; its coordinator may have ended before it was recorded");
        knows_devices_ = false;
        ++done_;
        return true;
    }
    const program_event_t* there = next();
    const bool is_other = there != nullptr && there->of_program != 0;
    return differ(event + " is not in the log" + (is_other ? ", which has that of " + place_of(*there) : ""),
                  planned.line.value_or(0), {}, is_other ? std::optional(Tick{there->tick}) : std::nullopt);
}

void EventCheck::note(const PathEvent& event) {
    devices_.apply(event.event);
    pop();
    ++done_;
    ++findings_.events;
}

void EventCheck::check_motion(std::span<const EpochRunner::Happened> planned, bool may_end_early) {
    for (const auto& [tick, event] : planned) {
        if (!findings_.going()) { return; }
        if (is_done() || event.block < next_block()) { continue; }  // published at an earlier rest
        skip_repeats();
        while (!is_done() && next_block() < event.block) {
            if (!lacks(event_at(next_block()))) { return; }
        }
        const program_event_t* there = next();
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
    while (findings_.going() && !is_done() && next_block() < may) {
        const PathEvent planned = event_at(next_block());
        skip_repeats();
        const program_event_t* there = next();
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
    forget_job();
    program_.reset();
    knows_devices_ = false;
}

void EventCheck::forget_job() {
    for (const std::int64_t coordinator : coordinators_) { waiting_.erase({job_, coordinator}); }
    coordinators_.clear();
}

void EventCheck::end(JobOutcome outcome) {
    const bool is_done = outcome == JobOutcome::Done;
    if (!findings_.going() || coordinators_.empty()) { return; }
    skip_repeats();
    const program_event_t* there = next();
    if (there != nullptr && (is_done || there->of_program != 0)) {
        (void)differ(fmt::format("an event of {}, {}, is recorded, which its program does not have there",
                                 place_of(*there), text_of(*there)),
                     there->line, {}, Tick{there->tick});
        return;
    }
    if (!is_done) { check_switched_off(outcome); }
    forget_job();
}

/// Compares the events of the coordinator that ended the job.
void EventCheck::check_switched_off(JobOutcome outcome) {
    using Kind = ProgramEvent::Kind;
    const bool turns = devices_.spindle != ProgramDevices::Spindle::Stopped;
    if (!check_off(Kind::SpindleStop, 0, turns) || !check_off(Kind::CoolantOff, 0, devices_.mist || devices_.flood)) {
        return;
    }
    for (const OutputConfig& output : outputs_) {
        const ProgramEvent end = end_of(output);
        const bool is_off_already = end.kind == Kind::SpindleStop || end.kind == Kind::CoolantOff;
        if (is_off_already || output.stays_after(outcome == JobOutcome::Failed)) { continue; }
        if (!check_off(end.kind, end.index, is_active(output, devices_))) { return; }
    }
    if (const program_event_t* more = next()) {
        (void)differ("the job's end switched more off than was on: " + text_of(*more), 0, {}, Tick{more->tick});
    }
}

/// Returns false if the next event is not the planned one.
bool EventCheck::check_off(ProgramEvent::Kind kind, std::int32_t index, bool is_planned) {
    const program_event_t* there = next();
    const bool is_there = there != nullptr && there->kind == name_of(kind) && there->index == index;
    if (knows_devices_ && is_there != is_planned) {
        return differ(std::string(name_of(kind)) + (is_there ? " is recorded at the job's end, but it was off"
                                                             : " is not recorded at the job's end"),
                      0, {}, is_there ? std::optional(Tick{there->tick}) : std::nullopt);
    }
    if (!is_there) { return true; }
    devices_.apply({.kind = kind, .index = index});
    pop();
    ++findings_.events;
    return true;
}

/// A fault after the end of a job switches outputs off.
void EventCheck::apply_later_ends(std::int64_t job) {
    for (auto& [whose, events] : waiting_) {
        if (whose.first >= job) { return; }
        std::erase_if(events, [&](const program_event_t& event) {
            const auto switched = event.of_program == 0 ? event_of(event) : std::nullopt;
            if (switched) { devices_.apply(*switched); }
            return event.of_program == 0;
        });
    }
}

void EventCheck::finish() {
    for (const auto& [whose, events] : waiting_) {
        const auto extra = std::ranges::find_if(events, [](const auto& event) { return event.of_program != 0; });
        if (extra == events.end() || is_heirs(*extra)) { continue; }
        label_ = fmt::format("job {}", whose.first);
        (void)differ(fmt::format("an event of {}, {}, is recorded, but its job is not in progress", place_of(*extra),
                                 text_of(*extra)),
                     extra->line, {}, Tick{extra->tick});
        return;
    }
}

/// Always returns false.
bool EventCheck::differ(const std::string& text, std::int32_t line, std::optional<Tick> expected,
                        std::optional<Tick> seen) {
    std::string commanded = label_;
    if (line != 0) { commanded += fmt::format(", line {}", line); }
    if (epoch_ != 0) { commanded += fmt::format(", epoch {}", epoch_); }
    findings_.differ(
        {.text = text, .axis = {}, .tick_expected = expected, .tick_seen = seen, .commanded = std::move(commanded)});
    return false;
}

}  // namespace lockstep::verification
