#include "clients/analysis/measure/speed_meter.hpp"

namespace lockstep::analysis {

void SpeedMeter::interrupt() {
    if (past_.size() > 1 && !measured_) { peak_speed_ = std::max(peak_speed_, least_speed_since(0)); }
    past_.clear();
    windows_.clear();
    measured_ = false;
    speed_first_ = late_first_ = 0;
}

void SpeedMeter::begin_stretch(StepEdge edge, bool rested) {
    if (rested && edge.direction == direction_) {
        peak_speed_ = std::max(peak_speed_, 1 / static_cast<double>((edge.tick - past_.back()).value));
    }
    interrupt();
    direction_ = edge.direction;
}

void SpeedMeter::forget() {
    const std::size_t gone = std::min(speed_first_, late_first_);
    past_.erase(past_.begin(), past_.begin() + static_cast<std::ptrdiff_t>(gone));
    if (windows_.size() > past_.size()) {
        windows_.erase(windows_.begin(), windows_.end() - static_cast<std::ptrdiff_t>(past_.size()));
    }
    speed_first_ -= gone;
    late_first_ -= gone;
    room_ = std::max(kKept, 2 * past_.size());
}

}  // namespace lockstep::analysis
