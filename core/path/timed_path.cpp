#include "core/path/timed_path.hpp"

#include <algorithm>
#include <cmath>

namespace lockstep {
namespace {

constexpr double kShortest_ticks = 1e-9;

PathPhase phase_on(const Quadratic& shape, const Interval& part, std::size_t number) {
    return {.shape = &shape, .interval = number, .piece = part.piece, .origin = {shape.piece, shape.begin}};
}

}  // namespace

StraightPassage::StraightPassage(const Interval& part, double w0, double w1) {
    const double mm = part.length();
    const double up = part.acceleration;
    const double down = part.deceleration;
    const double peak = (2 * up * down * mm + down * w0 + up * w1) / (up + down);
    top = std::max({std::min(peak, part.top), w0, w1});
    rise = std::min((top - w0) / (2 * up), mm);
    fall = std::min((top - w1) / (2 * down), mm - rise);
}

double PathPhase::along(double t) const {
    const double into = std::clamp(t - begin, 0.0, ticks);
    return u + (v + a * into / 2) * into;
}

double PathPhase::speed(double t) const { return v + a * std::clamp(t - begin, 0.0, ticks); }

double PathPhase::time_at(double along) const {
    const double mm = along - u;
    const double sum = v + std::sqrt(std::max(0.0, v * v + 2 * a * mm));
    return begin + (sum > 0 ? 2 * mm / sum : 0);
}

void TimedPath::begin(double ticks) {
    phases_.clear();
    passages_.clear();
    end_ = ticks;
    breaks_ = false;
    stop_ = {};
}

void TimedPath::add_phase(const PathPhase& phase) {
    if (phase.ticks < kShortest_ticks) { return; }
    phases_.push_back(phase);
    phases_.back().begin = end_;
    phases_.back().breaks = breaks_;
    breaks_ = false;
    end_ += phase.ticks;
}

/// Adds a phase in which the square of the speed changes linearly from w0 to w1 over `mm`.
void TimedPath::add(PathPhase phase, double mm, double u, double w0, double w1) {
    if (mm <= 0) { return; }
    phase.u = u;
    phase.v = std::sqrt(w0);
    const double v1 = std::sqrt(w1);
    phase.ticks = ticks_over(mm, phase.v, v1);
    phase.a = (v1 - phase.v) / phase.ticks;
    add_phase(phase);
}

/// One piece may span rests that follow each other. Otherwise each of many short rests would take a piece, and a frame
/// has room for few.
void TimedPath::pass(const Quadratic& shape, const Interval& part, std::size_t number, double w0, double w1) {
    passages_.push_back({number, end_, w0, w1, phases_.size()});
    const PathPhase here = phase_on(shape, part, number);
    const bool is_rest = part.kind == IntervalKind::Rest;
    const bool has_rested = stop_.shape != nullptr && stop_.shape->length == 0;
    stop_ = here;
    stop_.ticks = 0x1p40;
    stop_.u = part.to;
    breaks_ = part.jump * std::sqrt(w0) > kBreak || (is_rest && !has_rested);
    if (is_rest) {
        PathPhase rest = here;
        rest.ticks = static_cast<double>(shape.rest.value);
        add_phase(rest);
        breaks_ = true;
        return;
    }
    const double mm = part.length();
    if (part.kind == IntervalKind::Curved) { return add(here, mm, part.from, w0, w1); }
    const StraightPassage straight(part, w0, w1);
    add(here, straight.rise, part.from, w0, straight.top);
    add(here, mm - straight.rise - straight.fall, part.from + straight.rise, straight.top, straight.top);
    add(here, straight.fall, part.to - straight.fall, straight.top, w1);
}

void TimedPath::brake(const Quadratic& shape, const Interval& part, std::size_t number, double w0, double w1) {
    passages_.push_back({number, end_, w0, 0, phases_.size()});
    breaks_ = part.jump * std::sqrt(w0) > kBreak;
    const double mm = w0 > 0 ? part.length() * w0 / (w0 - w1) : 0;
    const PathPhase here = phase_on(shape, part, number);
    stop_ = here;
    stop_.ticks = 0x1p40;
    stop_.u = part.from + mm;
    add(here, mm, part.from, w0, 0);
}

PathSpot TimedPath::spot_at(double t) const {
    std::size_t k = 0;
    while (k + 1 < phases_.size() && phases_[k].end() <= t) { ++k; }
    return phases_[k].spot(phases_[k].along(t));
}

void TimedPath::shift(Ticks ticks) {
    for (PathPhase& phase : phases_) { phase.begin -= static_cast<double>(ticks.value); }
    for (Passage& passage : passages_) { passage.begin -= static_cast<double>(ticks.value); }
    end_ -= static_cast<double>(ticks.value);
}

void TimedPath::rest() {
    if (stop_.shape == nullptr) { return; }
    breaks_ = true;
    const double end = end_;
    add_phase(stop_);
    end_ = end;
}

}  // namespace lockstep
