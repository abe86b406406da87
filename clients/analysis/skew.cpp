#include "clients/analysis/skew.hpp"

#include <cstdlib>
#include <iterator>
#include <optional>

namespace lockstep::analysis {
namespace {

Ticks amount(Ticks ticks) { return {std::abs(ticks.value)}; }

/// The least amount that a share of all is not above.
Ticks quantile(const std::map<Ticks, std::int64_t>& amounts, std::int64_t all, std::int64_t percent) {
    std::int64_t seen = 0;
    for (const auto& [ticks, times] : amounts) {
        seen += times;
        if (seen * 100 >= all * percent) { return ticks; }
    }
    return {};
}

PairSkew summary_of(const std::pair<std::string, std::string>& axes, const std::map<Ticks, std::int64_t>& amounts) {
    PairSkew skew{.first = axes.first, .second = axes.second};
    for (const auto& [ticks, times] : amounts) { skew.steps += times; }
    skew.median = quantile(amounts, skew.steps, 50);
    skew.p99 = quantile(amounts, skew.steps, 99);
    skew.largest = amounts.rbegin()->first;
    return skew;
}

}  // namespace

Lateness& SkewMeter::lateness(const std::string& axis) {
    auto& found = axes_[axis];
    if (!found) {
        found = std::make_unique<Lateness>([this, axis](const Run& run, std::vector<LateStep> steps) {
            for (const LateStep& step : steps) {
                if (on_late_) { on_late_(axis, step); }
            }
            frames_[{run.start, run.epoch}][axis] = std::move(steps);
            if (frames_.size() > kFramesWaiting) { take_first_frame(); }
        });
    }
    return *found;
}

void SkewMeter::take_first_frame() {
    const Steps steps = std::move(frames_.extract(frames_.begin()).mapped());
    for (auto first = steps.begin(); first != steps.end(); ++first) {
        for (auto second = std::next(first); second != steps.end(); ++second) { take_pair(*first, *second); }
    }
}

/// Both axes' steps in the order of the ticks commanded.
void SkewMeter::take_pair(const Steps::value_type& first, const Steps::value_type& second) {
    const auto& a = first.second;
    const auto& b = second.second;
    std::optional<Ticks> late_a;
    std::optional<Ticks> late_b;
    for (std::size_t i = 0, j = 0; i < a.size() || j < b.size();) {
        const bool is_a = j == b.size() || (i < a.size() && a[i].commanded <= b[j].commanded);
        const bool is_b = i == a.size() || (j < b.size() && b[j].commanded <= a[i].commanded);
        if (is_a) { late_a = a[i++].late; }
        if (is_b) { late_b = b[j++].late; }
        if (late_a && late_b) { ++skews_[{first.first, second.first}][amount(*late_a - *late_b)]; }
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
