#include "clients/analysis/speed_meter.hpp"

#include <algorithm>
#include <cmath>
#include <cstdlib>

namespace lockstep::analysis {
namespace {

constexpr std::int64_t kLeastSteps = 8;
constexpr Ticks kSpeedWindow{1'000};
constexpr Ticks kAccelerationWindow{10'000};
// Two windows of acceleration at a step every tick, and some.
constexpr std::int64_t kRing = 32'768;

}  // namespace

SpeedMeter::SpeedMeter() : ring_(kRing) {}

void SpeedMeter::interrupt() {
    if (newest_ >= 1 && !measured_) { peak_speed_ = std::max(peak_speed_, speed({0, newest_})); }
    newest_ = -1;
    measured_ = false;
    speed_window_ = late_ = early_ = {};
}

std::optional<Sample> SpeedMeter::step(StepEdge edge) {
    const bool turned = edge.direction != direction_;
    const bool rested = newest_ >= 0 && edge.tick - Tick{tick(newest_)} > kRest;
    if (rested && !turned) {
        peak_speed_ = std::max(peak_speed_, 1 / static_cast<double>(edge.tick.value - tick(newest_)));
    }
    if (turned || rested) { interrupt(); }
    direction_ = edge.direction;
    ++newest_;
    ring_[static_cast<std::size_t>(newest_ % kRing)] = edge.tick.value;
    measure_acceleration();
    return measure_speed();
}

std::optional<Sample> SpeedMeter::measure_speed() {
    speed_window_.last = newest_;
    if (!is_wide(speed_window_, kSpeedWindow)) { return std::nullopt; }
    narrow(speed_window_, kSpeedWindow);
    measured_ = true;
    peak_speed_ = std::max(peak_speed_, speed(speed_window_));
    const std::int64_t first = tick(speed_window_.first);
    return Sample{Tick{first + (tick(newest_) - first) / 2}, direction_ * speed(speed_window_)};
}

void SpeedMeter::measure_acceleration() {
    acceleration_.reset();
    late_.last = newest_;
    if (!is_wide(late_, kAccelerationWindow)) { return; }
    narrow(late_, kAccelerationWindow);
    early_.last = late_.first;
    if (!is_wide(early_, kAccelerationWindow)) { return; }
    narrow(early_, kAccelerationWindow);
    const double change = speed(late_) - speed(early_);
    const double acceleration = change / (middle(late_) - middle(early_));
    acceleration_ = Sample{Tick{tick(late_.first)}, direction_ * acceleration};
    peak_acceleration_ = std::max(peak_acceleration_, std::abs(acceleration));
}

std::int64_t SpeedMeter::tick(std::int64_t number) const { return ring_[static_cast<std::size_t>(number % kRing)]; }

bool SpeedMeter::is_wide(Window window, Ticks least) const {
    return window.last - window.first >= kLeastSteps && tick(window.last) - tick(window.first) >= least.value;
}

/// Moves the first step as late as the window allows.
void SpeedMeter::narrow(Window& window, Ticks least) const {
    while (is_wide({window.first + 1, window.last}, least)) { ++window.first; }
}

double SpeedMeter::speed(Window window) const {
    return static_cast<double>(window.last - window.first) /
           static_cast<double>(tick(window.last) - tick(window.first));
}

double SpeedMeter::middle(Window window) const {
    return static_cast<double>(tick(window.first)) / 2 + static_cast<double>(tick(window.last)) / 2;
}

}  // namespace lockstep::analysis
