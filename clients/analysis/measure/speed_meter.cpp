#include "clients/analysis/measure/speed_meter.hpp"

#include "clients/analysis/measure/vector_clones.hpp"

namespace lockstep::analysis {

void SpeedMeter::interrupt() {
    if (past_.size() > 1 && !measured_) { peak_speed_ = std::max(peak_speed_, least_speed_since(0)); }
    past_.clear();
    window_from_.clear();
    window_speed_.clear();
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
    window_from_.erase(window_from_.begin(), window_from_.begin() + static_cast<std::ptrdiff_t>(gone));
    window_speed_.erase(window_speed_.begin(), window_speed_.begin() + static_cast<std::ptrdiff_t>(gone));
    base_ += Ticks{passed};
    for (std::int32_t& tick : past_) { tick -= passed; }
    for (std::int32_t& tick : window_from_) { tick -= passed; }
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
    window_from_.resize(past_.size());
    window_speed_.resize(past_.size());
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

LOCKSTEP_VECTOR_CLONES
void SpeedMeter::measure_speeds(std::size_t from, Block& measured) {
    Begins begins;
    narrow_all(speed_first_, kSpeedWindow, from, begins);
    std::array<std::int32_t, kBlock> middles;
    std::array<double, kBlock> speeds;
    const std::int32_t* const past = past_.data();
    const auto newest = static_cast<std::int32_t>(from);
    for (std::int32_t i = 0; i < kLanes; ++i) {
        const std::int32_t first = past[begins[i]];
        const std::int32_t lasts = past[newest + i] - first;
        middles[i] = first + lasts / 2;
        speeds[i] = static_cast<double>(newest + i - begins[i]) / static_cast<double>(lasts);
    }
    double peak = peak_speed_;
    const double sign = direction_;
    for (std::int32_t i = 0; i < kLanes; ++i) {
        peak = peak > speeds[i] ? peak : speeds[i];
        measured.speed[i] = sign * speeds[i];
        measured.speed_at[i] = base_ + Ticks{middles[i]};
    }
    peak_speed_ = peak;
}

LOCKSTEP_VECTOR_CLONES
void SpeedMeter::measure_accelerations(std::size_t from, Block& measured) {
    Begins begins;
    narrow_all(late_first_, kAccelerationWindow, from, begins);
    std::array<double, kBlock> changes;
    const std::int32_t* const past = past_.data();
    const auto newest = static_cast<std::int32_t>(from);
    for (std::int32_t i = 0; i < kLanes; ++i) {
        const std::int32_t first = past[begins[i]];
        window_from_[from + i] = first;
        window_speed_[from + i] =
            static_cast<double>(newest + i - begins[i]) / static_cast<double>(past[newest + i] - first);
    }
    for (std::int32_t i = 0; i < kLanes; ++i) {
        const double ticks = 0.5 * (past[newest + i] - window_from_[begins[i]]);
        changes[i] = (window_speed_[newest + i] - window_speed_[begins[i]]) / ticks;
        measured.acceleration_at[i] = base_ + Ticks{past[begins[i]]};
    }
    double peak = peak_acceleration_;
    const double sign = direction_;
    for (std::int32_t i = 0; i < kLanes; ++i) {
        peak = peak > std::abs(changes[i]) ? peak : std::abs(changes[i]);
        measured.acceleration[i] = sign * changes[i];
    }
    peak_acceleration_ = peak;
    acceleration_ = Sample{measured.acceleration_at.back(), measured.acceleration.back()};
}

/// narrow() for each step of a block.
void SpeedMeter::narrow_all(std::size_t& first, std::int32_t least, std::size_t from, Begins& begins) const {
    (void)narrow(first, least, from);
    if (!narrow_near(first, least, from, begins)) {
        begins[0] = static_cast<std::int32_t>(first);
        for (std::size_t i = 1; i < kBlock; ++i) {
            (void)narrow(first, least, from + i);
            begins[i] = static_cast<std::int32_t>(first);
        }
    }
    first = static_cast<std::size_t>(begins.back());
}

/// Finds windows of almost equally many steps, without branches, which would be mispredicted. `first` is the begin of
/// the first one. Returns false if they have other numbers of steps.
LOCKSTEP_VECTOR_CLONES
bool SpeedMeter::narrow_near(std::size_t first, std::int32_t least, std::size_t from, Begins& begins) const {
    constexpr std::int32_t kNear = 3;  // steps more or fewer
    if (first < kNear) { return false; }
    const std::int32_t* const newest = past_.data() + from;
    const std::int32_t* const shortest = newest - kLeastSteps;
    const std::int32_t* const longest = past_.data() + first - kNear;
    const auto earliest = static_cast<std::int32_t>(first) - kNear - 1;
    const auto latest = static_cast<std::int32_t>(from - kLeastSteps);
    std::int32_t are_shortest = 1;
    for (std::int32_t i = 0; i < kLanes; ++i) { are_shortest &= shortest[i] <= newest[i] - least ? 1 : 0; }
    if (are_shortest != 0) {
        for (std::int32_t i = 0; i < kLanes; ++i) { begins[i] = latest + i; }
        return true;
    }
    std::int32_t are_near = 1;
    for (std::int32_t i = 0; i < kLanes; ++i) {
        const std::int32_t until = newest[i] - least;
        std::int32_t fit = 0;
        for (std::int32_t k = 0; k <= 2 * kNear; ++k) { fit += longest[i + k] <= until ? 1 : 0; }
        are_near &= fit > 0 && longest[i + 2 * kNear + 1] > until ? 1 : 0;
        const std::int32_t begin = earliest + i + fit;
        begins[i] = begin < latest + i ? begin : latest + i;
    }
    return are_near != 0;
}

}  // namespace lockstep::analysis
