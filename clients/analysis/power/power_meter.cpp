#include "clients/analysis/power/power_meter.hpp"

#include <algorithm>
#include <cmath>
#include <limits>
#include <utility>

namespace lockstep::analysis {
namespace {

double distance(drawing::Point a, drawing::Point b) { return std::hypot(a.x - b.x, a.y - b.y); }

}  // namespace

void PowerMeter::take(const channel_event_t& message) {
    track_.take(message);
    if (!track_.is_full() || knots_.empty()) { return; }
    end_chord();
    const auto change = track_.next_until(Tick{std::numeric_limits<std::int64_t>::max()});
    move({std::max(change->at, now_.tick), now_.mm});
    apply(*change, now_.mm);
}

void PowerMeter::at(Tick tick, drawing::Point place_mm) {
    if (!knots_.empty() && distance(knots_.back().mm, place_mm) > chord_mm_) { part(); }
    if (knots_.empty()) {
        while (const auto change = track_.next_until(tick)) { apply(*change, place_mm); }
        now_ = {tick, place_mm};
    }
    knots_.push_back({tick, place_mm});
    if (distance(knots_.front().mm, place_mm) >= chord_mm_ || knots_.size() == kMostKnots) { end_chord(); }
}

void PowerMeter::part() {
    if (!knots_.empty()) { end_chord(); }
    knots_.clear();
    last_step_ = {};
}

void PowerMeter::finish() {
    part();
    settle();
}

/// The path goes straight from the first knot to the last, and passes the places beside the others at their times.
void PowerMeter::end_chord() {
    const drawing::Point from = knots_.front().mm;
    const drawing::Point way{knots_.back().mm.x - from.x, knots_.back().mm.y - from.y};
    const double square = way.x * way.x + way.y * way.y;
    double share = 0;
    for (std::size_t k = 1; k < knots_.size(); ++k) {
        const drawing::Point there{knots_[k].mm.x - from.x, knots_[k].mm.y - from.y};
        const double along = square > 0 ? (there.x * way.x + there.y * way.y) / square : 1;
        share = std::clamp(along, share, 1.0);
        step({knots_[k].tick, place_between(from, knots_.back().mm, share)});
    }
    knots_ = {knots_.back()};
}

/// If it takes much longer than the step before, the path rests halfway.
void PowerMeter::step(Place to) {
    const Ticks before = std::max(last_step_, Ticks{1});
    last_step_ = to.tick - now_.tick;
    const bool rests =
        last_step_ > before * kRestRatio && static_cast<double>(last_step_.value) * tick_s_ > kShortestRest_s;
    if (rests) {
        const drawing::Point halfway = place_between(now_.mm, to.mm, 0.5);
        move({now_.tick + before, halfway});
        move({to.tick - before, halfway});
    }
    move(to);
}

/// Straight and evenly to here, through all changes until then.
void PowerMeter::move(Place to) {
    const Place from = now_;
    const double lasts = static_cast<double>((to.tick - from.tick).value);
    const auto place_at = [&](Tick tick) {
        const double share = lasts > 0 ? static_cast<double>((tick - from.tick).value) / lasts : 1;
        return Place{tick, place_between(from.mm, to.mm, share)};
    };
    while (const auto change = track_.next_until(to.tick)) {
        const Place there = place_at(std::clamp(change->at, now_.tick, std::max(now_.tick, to.tick)));
        add(now_, there);
        now_ = there;
        apply(*change, there.mm);
    }
    add(now_, to);
    now_ = to;
}

/// Divides the part where the power gets to 0 or to full scale and stays there.
void PowerMeter::add(Place from, Place to) {
    const auto end = power_ ? power_->end() : std::nullopt;
    if (!end || *end <= from.tick || *end >= to.tick) { return add_even(from, to); }
    const double share =
        static_cast<double>((*end - from.tick).value) / static_cast<double>((to.tick - from.tick).value);
    const Place there{*end, place_between(from.mm, to.mm, share)};
    add_even(from, there);
    add_even(there, to);
}

void PowerMeter::add_even(Place from, Place to) {
    PowerSums sums{.path_mm = distance(from.mm, to.mm)};
    if (power_) {
        const double power = (power_->value_at(from.tick) + power_->value_at(to.tick)) / 2;
        sums.burned_mm = power > 0 ? sums.path_mm : 0;
        sums.power_mm = power * sums.path_mm;
        sums.energy_s = power * static_cast<double>((to.tick - from.tick).value) * tick_s_;
    } else {
        sums.unknown_mm = sums.path_mm;
    }
    if (!sums.is_empty()) { pending_.add(from.mm, to.mm, sums); }
}

void PowerMeter::apply(const PowerChange& change, drawing::Point place_mm) {
    if (change.follows_gap) {
        pending_.forget_power();
        power_.reset();
    }
    settle();
    if (!change.ramp) { return; }
    power_ = change.ramp;
    if (changes_.size() < kChangesKept) { changes_.push_back({change.at, place_mm}); }
}

void PowerMeter::settle() {
    if (pending_.is_empty()) { return; }
    made_.add(pending_);
    pending_ = PowerGrid(made_.cell_mm(), PowerGrid::Keeps::All);
}

}  // namespace lockstep::analysis
