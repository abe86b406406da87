#include "clients/analysis/measure/speed_meter.hpp"

namespace lockstep::analysis {

void SpeedMeter::interrupt() {
    if (past_.size() > 1 && !measured_) { peak_speed_ = std::max(peak_speed_, least_speed_since(0)); }
    past_.clear();
    windows_.clear();
    windows_from_ = kNone;
    measured_ = false;
    speed_first_ = late_first_ = 0;
}

void SpeedMeter::begin_stretch(StepEdge edge, bool rested) {
    if (rested && edge.direction == direction_) {
        peak_speed_ = std::max(peak_speed_, 1 / static_cast<double>((edge.tick - tick(past_.size() - 1)).value));
    }
    interrupt();
    direction_ = edge.direction;
}

double SpeedMeter::least_speed_since(std::size_t first) const {
    return static_cast<double>(past_.size() - 1 - first) / static_cast<double>(past_.back() - past_[first] + 1);
}

void SpeedMeter::forget() {
    const std::size_t gone = std::min(speed_first_, late_first_);
    const std::int32_t passed = past_[gone];
    past_.erase(past_.begin(), past_.begin() + static_cast<std::ptrdiff_t>(gone));
    windows_.erase(windows_.begin(), windows_.begin() + static_cast<std::ptrdiff_t>(gone));
    base_ += Ticks{passed};
    for (std::int32_t& tick : past_) { tick -= passed; }
    for (Window& window : windows_) { window.from -= passed; }
    if (windows_from_ != kNone) { windows_from_ -= std::min(windows_from_, gone); }
    speed_first_ -= gone;
    late_first_ -= gone;
    room_ = std::max(kKept, 2 * past_.size());
}

bool SpeedMeter::steps(std::span<const StepEdge, kBlock> edges, Block& measured) {
    if (past_.empty() || !has_early_window(late_first_) || !goes_on(edges)) { return false; }
    if (past_.size() + kBlock > room_) { forget(); }
    const std::size_t from = past_.size();
    for (const StepEdge& edge : edges) { past_.push_back(static_cast<std::int32_t>((edge.tick - base_).value)); }
    windows_.resize(past_.size());
    measure_speeds(from, measured);
    measure_accelerations(from, measured);
    return true;
}

/// Whether the steps continue the motion. Then they complete windows, because the last step has.
bool SpeedMeter::goes_on(std::span<const StepEdge, kBlock> edges) const {
    bool goes_on = edges[0].tick - tick(past_.size() - 1) <= kRest && edges[0].direction == direction_;
    for (std::size_t i = 1; i < kBlock; ++i) {
        goes_on = goes_on && edges[i].tick - edges[i - 1].tick <= kRest && edges[i].direction == direction_;
    }
    return goes_on;
}

void SpeedMeter::measure_speeds(std::size_t from, Block& measured) {
    Begins begins;
    narrow_all(speed_first_, kSpeedWindow, from, begins);
    std::array<double, kBlock> steps;
    std::array<double, kBlock> ticks;
    for (std::size_t i = 0; i < kBlock; ++i) {
        const std::int32_t first = past_[begins[i]];
        const std::int32_t lasts = past_[from + i] - first;
        steps[i] = static_cast<double>(from + i - begins[i]);
        ticks[i] = static_cast<double>(lasts);
        measured.speed_at[i] = base_ + Ticks{first + lasts / 2};
    }
    for (std::size_t i = 0; i < kBlock; ++i) { steps[i] /= ticks[i]; }
    for (std::size_t i = 0; i < kBlock; ++i) {
        peak_speed_ = std::max(peak_speed_, steps[i]);
        measured.speed[i] = direction_ * steps[i];
    }
}

void SpeedMeter::measure_accelerations(std::size_t from, Block& measured) {
    Begins begins;
    narrow_all(late_first_, kAccelerationWindow, from, begins);
    std::array<double, kBlock> speeds;
    std::array<double, kBlock> ticks;
    for (std::size_t i = 0; i < kBlock; ++i) {
        speeds[i] = static_cast<double>(from + i - begins[i]);
        ticks[i] = static_cast<double>(past_[from + i] - past_[begins[i]]);
    }
    for (std::size_t i = 0; i < kBlock; ++i) { speeds[i] /= ticks[i]; }
    for (std::size_t i = 0; i < kBlock; ++i) { windows_[from + i] = {past_[begins[i]], speeds[i]}; }
    for (std::size_t i = 0; i < kBlock; ++i) {
        const Window& early = windows_[begins[i]];
        speeds[i] -= early.speed;
        ticks[i] = 0.5 * (past_[from + i] - early.from);
        measured.acceleration_at[i] = tick(begins[i]);
    }
    for (std::size_t i = 0; i < kBlock; ++i) { speeds[i] /= ticks[i]; }
    for (std::size_t i = 0; i < kBlock; ++i) {
        peak_acceleration_ = std::max(peak_acceleration_, std::abs(speeds[i]));
        measured.acceleration[i] = direction_ * speeds[i];
    }
    acceleration_ = Sample{measured.acceleration_at.back(), measured.acceleration.back()};
}

/// narrow() for each step of a block.
void SpeedMeter::narrow_all(std::size_t& first, std::int32_t least, std::size_t from, Begins& begins) const {
    (void)narrow(first, least, from);
    if (!narrow_near(first, least, from, begins)) {
        begins[0] = first;
        for (std::size_t i = 1; i < kBlock; ++i) {
            (void)narrow(first, least, from + i);
            begins[i] = first;
        }
    }
    first = begins.back();
}

/// Finds windows of almost equally many steps, without branches, which would be mispredicted. `first` is the begin of
/// the first one. Returns false if they have other numbers of steps.
bool SpeedMeter::narrow_near(std::size_t first, std::int32_t least, std::size_t from, Begins& begins) const {
    constexpr std::size_t kNear = 3;  // steps more or fewer
    if (first < kNear) { return false; }
    const std::int32_t* newest = &past_[from];
    const std::int32_t* shortest = newest - kLeastSteps;
    const std::int32_t* longest = &past_[first - kNear];
    std::array<std::int32_t, kBlock> fit{};
    std::int32_t shortest_fit = 0;
    std::int32_t next_fit = 0;
    for (std::size_t i = 0; i < kBlock; ++i) { shortest_fit += shortest[i] <= newest[i] - least ? 1 : 0; }
    if (shortest_fit == kBlock) {
        for (std::size_t i = 0; i < kBlock; ++i) { begins[i] = from + i - kLeastSteps; }
        return true;
    }
    for (std::size_t k = 0; k <= 2 * kNear; ++k) {
        for (std::size_t i = 0; i < kBlock; ++i) { fit[i] += longest[i + k] <= newest[i] - least ? 1 : 0; }
    }
    for (std::size_t i = 0; i < kBlock; ++i) {
        next_fit += longest[i + 2 * kNear + 1] <= newest[i] - least ? 1 : 0;
        next_fit += fit[i] == 0 ? 1 : 0;
        begins[i] = std::min(first - kNear + i + static_cast<std::size_t>(fit[i]) - 1, from + i - kLeastSteps);
    }
    return next_fit == 0;
}

}  // namespace lockstep::analysis
