#include "clients/analysis/measure/skew.hpp"

#include "clients/analysis/vector/clones.hpp"

#include <algorithm>
#include <bit>
#include <iterator>
#include <span>

namespace lockstep::analysis {
namespace {

/// The smallest amount that at least this share of all amounts does not exceed.
Ticks quantile(const std::map<Ticks, std::int64_t>& amounts, std::int64_t all, std::int64_t percent) {
    std::int64_t seen = 0;
    for (const auto& [ticks, times] : amounts) {
        seen += times;
        if (seen * 100 >= all * percent) { return ticks; }
    }
    return {};
}

/// The group of a step, for steps in order.
class GroupCursor {
public:
    explicit GroupCursor(std::span<const EquallyLate> groups) : group_(groups.begin()), end_(group_->steps.size()) {}
    void go_to(std::size_t step) {
        while (step >= end_) { end_ += (++group_)->steps.size(); }
    }
    const EquallyLate* operator->() const { return &*group_; }

private:
    std::span<const EquallyLate>::iterator group_;
    std::size_t end_;  // one more than the number of its last step
};

}  // namespace

PairSkew SkewMeter::summary_of(const std::pair<std::string, std::string>& axes, const Amounts& amounts) {
    PairSkew skew{.first = axes.first, .second = axes.second, .error = amounts.error};
    for (const auto& [ticks, times] : amounts.times) { skew.steps += times; }
    skew.median = quantile(amounts.times, skew.steps, 50);
    skew.p99 = quantile(amounts.times, skew.steps, 99);
    skew.largest = amounts.times.rbegin()->first;
    return skew;
}

Lateness& SkewMeter::lateness(const std::string& axis) {
    auto& found = axes_[axis];
    if (!found) {
        found = std::make_unique<Lateness>(
            [this, axis](const Run& run, SharedLate steps) { on_run(axis, run, std::move(steps)); });
    }
    return *found;
}

void SkewMeter::on_run(const std::string& axis, const Run& run, SharedLate steps) {
    on_late_(axis, steps);
    const FrameKey frame{run.commanded_start(), run.epoch};
    frames_[frame][axis] = std::move(steps);
    latest_[axis] = std::max(latest_[axis], frame);
    while (frames_.size() > kFramesWaiting || all_are_past_first_frame()) { take_first_frame(); }
}

bool SkewMeter::all_are_past_first_frame() const {
    return !frames_.empty() && latest_.size() == axes_.size() &&
           std::ranges::all_of(latest_, [&](const auto& axis) { return axis.second > frames_.begin()->first; });
}

void SkewMeter::take_first_frame() {
    const Steps steps = std::move(frames_.extract(frames_.begin()).mapped());
    std::vector<AxisSteps> axes;
    for (const auto& axis : steps) {
        if (!axis.second->groups.empty()) { axes.push_back(steps_of(axis)); }
    }
    if (axes.size() > 1) { note_bits(axes); }
    for (std::size_t i = 0; i < axes.size(); ++i) {
        for (std::size_t j = i + 1; j < axes.size(); ++j) { take_pair(axes[i], axes[j]); }
    }
}

SkewMeter::AxisSteps SkewMeter::steps_of(const Steps::value_type& axis) {
    const auto& groups = axis.second->groups;
    AxisSteps all{.axis = axis.first,
                  .late = axis.second,
                  .first = groups.front().commanded(0),
                  .last = groups.back().commanded(groups.back().steps.size() - 1)};
    for (const EquallyLate& group : groups) {
        const bool is_alike = group.late == groups.front().late && group.error == groups.front().error;
        all.are_equally_late = all.are_equally_late && is_alike;
        all.size += group.steps.size();
    }
    return all;
}

std::int64_t SkewMeter::AxisSteps::from(Tick tick) const {
    std::int64_t steps = 0;
    for (const EquallyLate& group : late->groups) {
        if (group.commanded(group.steps.size() - 1) < tick) { continue; }
        steps += static_cast<std::int64_t>(group.steps.size() - group.steps.before(tick + group.late));
    }
    return steps;
}

const std::vector<Tick>& SkewMeter::AxisSteps::ticks() {
    if (!commanded.empty()) { return commanded; }
    commanded.reserve(size);
    for (const EquallyLate& group : late->groups) {
        for (std::size_t i = 0; i < group.steps.size(); ++i) { commanded.push_back(group.commanded(i)); }
    }
    return commanded;
}

void SkewMeter::take_pair(AxisSteps& a, AxisSteps& b) {
    Amounts& amounts = skews_[{a.axis, b.axis}];
    if (!a.are_equally_late || !b.are_equally_late) { return take_steps(a, b, amounts); }
    const EquallyLate& of_a = a.late->groups.front();
    const EquallyLate& of_b = b.late->groups.front();
    amounts.times[length_of(of_a.late - of_b.late)] += ticks_of_both(a, b);
    amounts.error = std::max(amounts.error, of_a.error + of_b.error);
}

/// The number of different commanded ticks of two axes, from the instant on at which both have a step.
std::int64_t SkewMeter::ticks_of_both(AxisSteps& a, AxisSteps& b) {
    const Tick from = std::max(a.first, b.first);
    const bool have_bits = !a.bits.empty() && !b.bits.empty();
    return a.from(from) + b.from(from) - (have_bits ? common_bits(a, b) : common_ticks(a, b));
}

/// Notes the steps of a frame as bits, unless most of the bits would be 0.
void SkewMeter::note_bits(std::vector<AxisSteps>& axes) {
    constexpr std::int64_t kTicksPerStep = 64;
    Tick first = axes.front().first;
    Tick last = axes.front().last;
    std::int64_t steps = 0;
    for (const AxisSteps& axis : axes) {
        first = std::min(first, axis.first);
        last = std::max(last, axis.last);
        steps += axis.are_equally_late ? static_cast<std::int64_t>(axis.size) : 0;
    }
    const std::int64_t ticks = (last - first).value + 1;
    if (ticks > steps * kTicksPerStep) { return; }
    for (AxisSteps& axis : axes) {
        if (!axis.are_equally_late) { continue; }
        axis.bits.resize(static_cast<std::size_t>(ticks + 63) / 64);
        for (const EquallyLate& group : axis.late->groups) {
            const std::int64_t later = (group.steps.origin() - (first + group.late)).value;
            for (const std::int32_t tick : std::span(group.steps.ticks(), group.steps.size())) {
                const auto bit = static_cast<std::uint64_t>(later + tick);
                axis.bits[bit / 64] |= std::uint64_t{1} << bit % 64;
            }
        }
    }
}

LOCKSTEP_VECTOR_CLONES
std::int64_t SkewMeter::common_bits(const AxisSteps& a, const AxisSteps& b) {
    std::int64_t ticks = 0;
    for (std::size_t i = 0; i < a.bits.size(); ++i) { ticks += std::popcount(a.bits[i] & b.bits[i]); }
    return ticks;
}

std::int64_t SkewMeter::common_ticks(AxisSteps& a, AxisSteps& b) {
    std::int64_t ticks = 0;
    auto at_a = a.ticks().begin();
    auto at_b = b.ticks().begin();
    while (at_a != a.commanded.end() && at_b != b.commanded.end()) {
        const Tick of_a = *at_a;
        const Tick of_b = *at_b;
        ticks += of_a == of_b ? 1 : 0;
        at_a += of_a <= of_b ? 1 : 0;
        at_b += of_b <= of_a ? 1 : 0;
    }
    return ticks;
}

/// Goes through both axes' steps in the order of the commanded ticks.
void SkewMeter::take_steps(AxisSteps& a, AxisSteps& b, Amounts& amounts) {
    const std::vector<Tick>& of_a = a.ticks();
    const std::vector<Tick>& of_b = b.ticks();
    auto same = amounts.times.end();  // the amount found last, since most are the same
    GroupCursor at_a(a.late->groups);
    GroupCursor at_b(b.late->groups);
    for (std::size_t i = 0, j = 0; i < of_a.size() || j < of_b.size();) {
        const bool is_a = j == of_b.size() || (i < of_a.size() && of_a[i] <= of_b[j]);
        const bool is_b = i == of_a.size() || (j < of_b.size() && of_b[j] <= of_a[i]);
        if (is_a) { at_a.go_to(i++); }
        if (is_b) { at_b.go_to(j++); }
        if (i == 0 || j == 0) { continue; }
        const Ticks found = length_of(at_a->late - at_b->late);
        if (same == amounts.times.end() || same->first != found) { same = amounts.times.try_emplace(found).first; }
        ++same->second;
        amounts.error = std::max(amounts.error, at_a->error + at_b->error);
    }
}

std::vector<PairSkew> SkewMeter::finish() {
    for (auto& [name, axis] : axes_) { axis->finish(); }
    while (!frames_.empty()) { take_first_frame(); }
    std::vector<PairSkew> pairs;
    for (const auto& [axes, amounts] : skews_) { pairs.push_back(summary_of(axes, amounts)); }
    return pairs;
}

}  // namespace lockstep::analysis
