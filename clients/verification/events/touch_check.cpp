#include "clients/verification/events/touch_check.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <utility>

namespace lockstep::verification {
namespace {

/// A device with a clock of its own: the time of the change was estimated twice.
Ticks within_of(const InputChange& change, const RecordedTouch::Input& input) {
    constexpr std::int64_t kRates = 1000;  // the clocks' rates differ by less than a thousandth
    if (change.clock_error == Ticks{}) { return {}; }
    return change.clock_error + change.clock_error + Ticks{2 + input.debounce.value / kRates};
}

}  // namespace

void TouchCheck::take(const InputChange& change) {
    settle(change.utime);
    changes_.emplace(change.tick, change);
    if (changes_.size() > kMostChanges) { changes_.erase(changes_.begin()); }
}

void TouchCheck::take(RecordedTouch touch) {
    settle(touch.utime);
    waiting_.push_back(std::move(touch));
}

void TouchCheck::settle(std::int64_t utime) {
    for (; !waiting_.empty() && waiting_.front().utime + kPatience_us < utime; waiting_.pop_front()) {
        compare(waiting_.front());
    }
}

/// In the motion, up to the recorded touch.
std::vector<TouchCheck::Seen> TouchCheck::touches_in(const RecordedTouch& touch) const {
    std::vector<Seen> found;
    for (const RecordedTouch::Input& input : touch.inputs) {
        bool is_awaited = true;
        for (auto of = changes_.lower_bound(touch.looked); of != changes_.end(); ++of) {
            const InputChange& change = of->second;
            if (change.motor != input.motor || change.channel != input.channel) { continue; }
            const Tick pin = change.tick - input.debounce;
            const Ticks within = within_of(change, input);
            if (pin > touch.end + within) { break; }
            const bool touches = change.closed != touch.opens;
            if (touches && pin > touch.begin) { found.push_back({input, pin, within, is_awaited}); }
            is_awaited = !touch.opens;
        }
    }
    return found;
}

/// A touch before the motion is of an input that touched already, and ends nothing.
void TouchCheck::compare(const RecordedTouch& touch) {
    if (touch.end <= touch.begin) { return; }
    std::string at_end;
    bool is_explained = !touch.touched;
    for (const Seen& seen : touches_in(touch)) {
        const bool is_at_end = touch.touched && seen.pin >= touch.end - seen.within;
        if (!is_at_end && seen.is_awaited) {
            return differ(touch, fmt::format("by the record of its inputs, input {} touched earlier", seen.input.name),
                          seen.pin);
        }
        if (!is_at_end) { continue; }
        is_explained = is_explained || touch.input.empty() || touch.input == seen.input.name;
        at_end = seen.input.name;
    }
    if (is_explained) { return; }
    if (!at_end.empty()) {
        return differ(touch, fmt::format("by the record of its inputs, input {} touched", at_end), touch.end);
    }
    if (unexplained_.size() < kMostOpen) { unexplained_.push_back(touch); }
}

void TouchCheck::differ(const RecordedTouch& touch, const std::string& text, std::optional<Tick> seen) {
    const std::string recorded =
        touch.touched ? fmt::format("the touch{} at tick {}", touch.input.empty() ? "" : " of input " + touch.input,
                                    touch.end.value)
                      : "a probing move without a touch";
    findings_.differ({.text = fmt::format("{}: the record has {}, but {}", touch.job, recorded, text),
                      .axis = {},
                      .tick_expected = seen,
                      .tick_seen = touch.touched ? std::optional(touch.end) : std::nullopt,
                      .commanded = touch.job});
}

/// A change that is not in the log may be one that was lost.
void TouchCheck::finish(const MayLack& may_lack) {
    for (const RecordedTouch& touch : waiting_) { compare(touch); }
    waiting_.clear();
    for (const RecordedTouch& touch : unexplained_) {
        const auto lacks = std::ranges::find_if(
            touch.inputs, [&](const RecordedTouch::Input& input) { return may_lack(input.motor); });
        if (lacks == touch.inputs.end()) {
            differ(touch, "by the record of its inputs, none of them touched then", {});
        } else {
            findings_.add_unknown(fmt::format("{}: the change of an input at the touch at tick {} is not in the log",
                                              touch.job, touch.end.value));
        }
    }
}

}  // namespace lockstep::verification
