#include "clients/verification/steps/output_check.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <utility>

#include "core/number_text.hpp"

namespace lockstep::verification {
namespace {

std::string text_of(const ChannelEvent& event) {
    if (event.kind == ChannelEvent::Kind::Digital) { return fmt::format("digital outputs {:#06b}", event.levels); }
    if (event.kind == ChannelEvent::Kind::CompareBegins) {
        return fmt::format("{} pulses at places begin at count {}", event.detail, event.value);
    }
    if (event.kind == ChannelEvent::Kind::CompareEnds) {
        return fmt::format("the pulses at places end at count {}, {} of them not made", event.value, event.detail);
    }
    const double scale = static_cast<double>(kFullScale);
    return fmt::format("analog output {} at {:.6f} with slope {:.3e}", event.channel,
                       static_cast<double>(event.value) / scale, static_cast<double>(event.detail) / scale);
}

bool is_of_output(const ChannelEvent& event) { return event.kind != ChannelEvent::Kind::Input; }

}  // namespace

/// Nothing is known across a gap.
void OutputCheck::lose() {
    seen_.clear();
    planned_.clear();
    levels_.reset();
}

void OutputCheck::take(const Seen& seen) {
    stream_.take(seen, [this](const Seen& next, Before before) { follow(next, before); });
}

void OutputCheck::follow(const Seen& seen, Before before) {
    const bool is_another = last_ && before == Before::OtherProcess;
    const bool is_gap = last_ && !is_another && (before == Before::Gap || seen.lost != last_->lost);
    const bool begins_late = before == Before::OtherProcess && seen.sequence > 0;
    if (is_gap) { note_gap(seen, before); }
    if (begins_late) { first_.try_emplace(seen.incarnation, seen); }
    if (is_another) { compare_passed(); }
    if (is_gap || is_another || begins_late) { lose(); }
    if (is_gap || begins_late) { unknown_until_ = seen.event.tick; }
    lacks_changes_ = lacks_changes_ || is_gap || begins_late;
    last_ = seen;
    if (!is_of_output(seen.event)) { return; }
    seen_.push_back(seen);
    compare_passed();
    if (seen_.size() > kMostWaiting) { lose(); }
}

void OutputCheck::note_gap(const Seen& seen, Before before) {
    const std::int64_t tick = seen.event.tick.value;
    if (before == Before::Gap) {
        findings_.add_missing(fmt::format("{}: {} of inputs and outputs missing before tick {}",
                                          findings_.label_of(axis_),
                                          plural(seen.sequence - last_->sequence - 1, "change"), tick));
    } else {
        findings_.add_missing(
            fmt::format("{}: its device could not keep all changes of inputs and outputs before "
                        "tick {}: {} lost before it, {} before the change at tick {}",
                        findings_.label_of(axis_), tick, seen.lost, last_->lost, last_->event.tick.value));
    }
}

/// The first changes of a process are missing if a mark before them counts fewer.
void OutputCheck::check_beginnings() {
    for (const auto& [incarnation, first] : first_) {
        const auto expected = expected_.find(incarnation);
        if (expected == expected_.end() || first.sequence <= expected->second) { continue; }
        findings_.add_missing(fmt::format("{}: {} of inputs and outputs missing before tick {}",
                                          findings_.label_of(axis_),
                                          plural(first.sequence - expected->second, "change"), first.event.tick.value));
    }
}

void OutputCheck::take(Planned planned) {
    planned_.push_back(std::move(planned));
    if (planned_.size() > kMostWaiting) { lose(); }
}

/// Events of a frame are complete when a later one was seen.
void OutputCheck::compare_passed() {
    while (!planned_.empty() && !seen_.empty() && seen_.back().event.tick > planned_.front().end) {
        compare(planned_.front());
        planned_.pop_front();
    }
}

Tick OutputCheck::Planned::tick_of(const OutputChange& change) const {
    if (!is_retimed) { return begin + change.at; }
    const double rate = static_cast<double>((end - begin).value) / static_cast<double>(ticks.value);
    return begin + Ticks{std::llround(rate * static_cast<double>(change.at.value))};
}

/// Changes that this frame asks for may be missing: none is compared.
void OutputCheck::pass(const Planned& planned) {
    for (; !seen_.empty() && seen_.front().event.tick <= planned.end; seen_.pop_front()) {
        const ChannelEvent& event = seen_.front().event;
        if (event.kind == ChannelEvent::Kind::Digital) { levels_ = event.levels; }
    }
}

/// An event is expected only where a change has an effect: digital outputs that keep their levels make none.
std::vector<OutputCheck::Expected> OutputCheck::expected_of(const Planned& planned) const {
    std::vector<Expected> expected;
    std::uint16_t levels = levels_.value_or(0);
    for (const OutputChange& change : planned.changes) {
        const Tick tick = planned.tick_of(change);
        if (const auto* digital = std::get_if<SetDigital>(&change.what)) {
            const auto next = static_cast<std::uint16_t>((levels & ~digital->mask) | (digital->levels & digital->mask));
            if (std::exchange(levels, next) == next) { continue; }
            expected.push_back({tick, {.tick = tick, .kind = ChannelEvent::Kind::Digital, .levels = next}});
        } else if (const auto* analog = std::get_if<RampAnalog>(&change.what)) {
            expected.push_back({tick,
                                {.tick = tick,
                                 .kind = ChannelEvent::Kind::Analog,
                                 .channel = analog->channel,
                                 .value = analog->value,
                                 .detail = analog->slope}});
        }
    }
    return expected;
}

/// A device with a clock of its own gets slopes and ticks that are fitted to it.
bool OutputCheck::is_same(const Expected& expected, const ChannelEvent& seen, const Planned& planned) const {
    const ChannelEvent& wanted = expected.event;
    if (seen.kind != wanted.kind) { return false; }
    const Ticks within = planned.is_retimed ? planned.clock_error + Ticks{2} : Ticks{};
    if (length_of(seen.tick - expected.tick) > within) { return false; }
    if (seen.kind == ChannelEvent::Kind::Digital) { return seen.levels == wanted.levels; }
    const bool is_value = seen.channel == wanted.channel && seen.value == wanted.value;
    if (!planned.is_retimed) { return is_value && seen.detail == wanted.detail; }
    constexpr double kRates = 1e-3;
    const auto slope = static_cast<double>(wanted.detail);
    return is_value && std::abs(static_cast<double>(seen.detail) - slope) <= kRates * std::abs(slope) + 1;
}

void OutputCheck::compare(const Planned& planned) {
    if (!findings_.going()) { return; }
    if (planned.begin < unknown_until_) { return pass(planned); }
    const auto note = [&](const ChannelEvent& event) {
        if (event.kind == ChannelEvent::Kind::Digital) { levels_ = event.levels; }
    };
    const auto is_before = [&](const Seen& seen) { return seen.event.tick <= planned.begin; };
    for (; !seen_.empty() && is_before(seen_.front()); seen_.pop_front()) { note(seen_.front().event); }
    const bool is_known = levels_.has_value() || std::ranges::none_of(planned.changes, [](const OutputChange& change) {
                              return std::holds_alternative<SetDigital>(change.what);
                          });
    const bool is_of_process = seen_.empty() || seen_.front().incarnation == planned.incarnation;
    if (!is_of_process || !compare_pulses(planned)) { return; }
    for (const Expected& expected : expected_of(planned)) {
        const bool has_one = !seen_.empty() && seen_.front().event.tick <= planned.end;
        if (!has_one && !is_known && expected.event.kind == ChannelEvent::Kind::Digital) { continue; }
        if (!has_one) {
            return differ(planned, "no change on record, but planned: " + text_of(expected.event), expected.tick, {});
        }
        const ChannelEvent& seen = seen_.front().event;
        if (!is_same(expected, seen, planned)) {
            if (!is_known && expected.event.kind == ChannelEvent::Kind::Digital) { continue; }
            return differ(planned, fmt::format("{}; planned: {}", text_of(seen), text_of(expected.event)),
                          expected.tick, seen.tick);
        }
        note(seen);
        seen_.pop_front();
        ++findings_.outputs;
    }
    const bool has_more = !seen_.empty() && seen_.front().event.tick < planned.end;
    if (has_more) {
        differ(planned, text_of(seen_.front().event) + ", which its frame does not ask for", {},
               seen_.front().event.tick);
    }
}

/// Takes the events of pulses out of those seen. Returns false if they are not as planned. A device with a clock of its
/// own was told the places about when the plan says.
bool OutputCheck::compare_pulses(const Planned& planned) {
    std::vector<ChannelEvent> seen;
    std::erase_if(seen_, [&](const Seen& one) {
        const bool is_over = ChannelEvent::is_of_pulses(one.event.kind) && one.event.tick <= planned.end;
        if (is_over && one.event.tick > planned.begin) { seen.push_back(one.event); }
        return is_over;
    });
    const auto& expected = planned.pulses;
    if (!expected) { return true; }
    for (std::size_t k = 0; k < std::max(seen.size(), expected->size()); ++k) {
        const auto tick = [k](const auto& list) {
            return k < list.size() ? std::optional(list[k].tick) : std::nullopt;
        };
        const auto text = [k](const auto& list) { return k < list.size() ? text_of(list[k]) : "nothing more"; };
        const Ticks within = planned.is_retimed ? planned.clock_error + Ticks{2} : Ticks{};
        const bool is_same = k < seen.size() && k < expected->size() && seen[k].kind == (*expected)[k].kind &&
                             seen[k].detail == (*expected)[k].detail &&
                             length_of(seen[k].tick - (*expected)[k].tick) <= within;
        if (!is_same) {
            differ(planned, text(seen) + "; the steps and the plan give: " + text(*expected), tick(*expected),
                   tick(seen));
            return false;
        }
        ++findings_.outputs;
    }
    return true;
}

void OutputCheck::differ(const Planned& planned, const std::string& text, std::optional<Tick> expected,
                         std::optional<Tick> seen) {
    findings_.differ({.text = findings_.label_of(axis_) + ": " + text,
                      .axis = axis_,
                      .tick_expected = expected,
                      .tick_seen = seen,
                      .commanded = planned.commanded});
}

void OutputCheck::finish(bool is_whole) {
    stream_.finish([this](const Seen& next, Before before) { follow(next, before); });
    compare_passed();
    check_beginnings();
    for (const Planned& planned : planned_) {
        if (is_whole) { compare(planned); }
    }
    planned_.clear();
}

}  // namespace lockstep::verification
