#include "core/path/timed_path.hpp"

#include <algorithm>
#include <cmath>

namespace lockstep {
namespace {

constexpr double kShortest_ticks = 1e-9;

}  // namespace

double PathPhase::along(double t) const {
    const double into = std::clamp(t - begin, 0.0, ticks);
    return u + (v + a * into / 2) * into;
}

double PathPhase::speed(double t) const { return v + a * std::clamp(t - begin, 0.0, ticks); }

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

/// The speed's square changes steadily from w0 to w1 over `mm`.
void TimedPath::add(const Quadratic& shape, std::size_t number, double mm, double u, double w0, double w1) {
    if (mm <= 0) { return; }
    const double v0 = std::sqrt(w0);
    const double v1 = std::sqrt(w1);
    const double ticks = 2 * mm / (v0 + v1);
    add_phase({.shape = &shape, .interval = number, .ticks = ticks, .u = u, .v = v0, .a = (v1 - v0) / ticks});
}

void TimedPath::pass(const Quadratic& shape, const Interval& part, std::size_t number, double w0, double w1) {
    passages_.push_back({number, end_, w0, w1, phases_.size()});
    stop_ = {.shape = &shape, .interval = number, .ticks = 0x1p40, .u = part.to};
    breaks_ = part.turn * std::sqrt(w0) > kBreak || part.kind == IntervalKind::Rest;
    if (part.kind == IntervalKind::Rest) {
        add_phase({.shape = &shape, .interval = number, .ticks = static_cast<double>(shape.rest.value)});
        breaks_ = true;
        return;
    }
    const double mm = part.length();
    if (part.kind == IntervalKind::Curved) { return add(shape, number, mm, part.from, w0, w1); }
    const double up = part.acceleration;
    const double down = part.deceleration;
    const double peak = (2 * up * down * mm + down * w0 + up * w1) / (up + down);
    const double top = std::max({std::min(peak, part.top), w0, w1});
    const double rise = std::min((top - w0) / (2 * up), mm);
    const double fall = std::min((top - w1) / (2 * down), mm - rise);
    add(shape, number, rise, part.from, w0, top);
    add(shape, number, mm - rise - fall, part.from + rise, top, top);
    add(shape, number, fall, part.to - fall, top, w1);
}

void TimedPath::brake(const Quadratic& shape, const Interval& part, std::size_t number, double w0, double w1) {
    passages_.push_back({number, end_, w0, 0, phases_.size()});
    breaks_ = part.turn * std::sqrt(w0) > kBreak;
    const double mm = w0 > 0 ? part.length() * w0 / (w0 - w1) : 0;
    stop_ = {.shape = &shape, .interval = number, .ticks = 0x1p40, .u = part.from + mm};
    add(shape, number, mm, part.from, w0, 0);
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
