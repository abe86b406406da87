#include "clients/analysis/measure/skew.hpp"

#include <algorithm>
#include <iterator>

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
    for (auto first = steps.begin(); first != steps.end(); ++first) {
        for (auto second = std::next(first); second != steps.end(); ++second) { take_pair(*first, *second); }
    }
}

/// Goes through both axes' steps in the order of the commanded ticks.
void SkewMeter::take_pair(const Steps::value_type& first, const Steps::value_type& second) {
    const auto& a = first.second->steps;
    const auto& b = second.second->steps;
    if (a.empty() || b.empty()) { return; }
    Amounts& amounts = skews_[{first.first, second.first}];
    auto same = amounts.times.end();  // the amount found last, since most are the same
    const LateStep* newest_a = nullptr;
    const LateStep* newest_b = nullptr;
    for (std::size_t i = 0, j = 0; i < a.size() || j < b.size();) {
        const bool is_a = j == b.size() || (i < a.size() && a[i].commanded <= b[j].commanded);
        const bool is_b = i == a.size() || (j < b.size() && b[j].commanded <= a[i].commanded);
        if (is_a) { newest_a = &a[i++]; }
        if (is_b) { newest_b = &b[j++]; }
        if (newest_a == nullptr || newest_b == nullptr) { continue; }
        const Ticks found = length_of(newest_a->late - newest_b->late);
        if (same == amounts.times.end() || same->first != found) { same = amounts.times.try_emplace(found).first; }
        ++same->second;
        amounts.error = std::max(amounts.error, newest_a->error + newest_b->error);
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
