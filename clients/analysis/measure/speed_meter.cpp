#include "clients/analysis/measure/speed_meter.hpp"

namespace lockstep::analysis {

std::optional<Sample> SpeedMeter::step(StepEdge edge) {
    const bool rested = !windows_.empty() && edge.tick - windows_.newest() > kRest;
    if (rested || edge.direction != direction_ || windows_.is_far(edge.tick)) { begin_stretch(edge, rested); }
    windows_.make_room(1);
    windows_.add(edge.tick);
    acceleration_ = windows_.acceleration();
    if (acceleration_) {
        peak_acceleration_ = std::max(peak_acceleration_, std::abs(acceleration_->value));
        acceleration_->value *= direction_;
    }
    std::optional<Sample> speed = windows_.speed();
    if (!speed) { return std::nullopt; }
    measured_ = true;
    peak_speed_ = std::max(peak_speed_, speed->value);
    speed->value *= direction_;
    return speed;
}

/// A motion that is shorter than a window counts as one. Rounding may have shortened it by a tick.
void SpeedMeter::interrupt() {
    if (windows_.size() > 1 && !measured_) {
        const auto ticks = static_cast<double>((windows_.newest() - windows_.tick(0)).value + 1);
        peak_speed_ = std::max(peak_speed_, static_cast<double>(windows_.size() - 1) / ticks);
    }
    windows_.clear();
    measured_ = false;
}

void SpeedMeter::begin_stretch(StepEdge edge, bool rested) {
    if (rested && edge.direction == direction_) {
        peak_speed_ = std::max(peak_speed_, 1 / static_cast<double>((edge.tick - windows_.newest()).value));
    }
    interrupt();
    direction_ = edge.direction;
}

std::size_t SpeedMeter::take_blocks(StepSpan steps) {
    if (!windows_.has_all_windows()) { return 0; }
    steps = steps.first(std::min(steps.size(), MotionWindows::kMostAdded));
    steps = steps.first(blocks_of_motion(steps) * kBlock);
    if (steps.empty()) { return 0; }
    windows_.make_room(steps.size());
    if (windows_.is_far(steps.tick(steps.size() - 1))) { return 0; }
    measured_until_ = windows_.size();
    windows_.add(steps);
    return steps.size();
}

/// The number of blocks whose steps continue the motion. They complete windows, because the last step has.
std::size_t SpeedMeter::blocks_of_motion(const StepSpan& steps) const {
    if (steps.empty() || steps.direction(0) != direction_) { return 0; }
    const std::size_t most = steps.one_way() / kBlock;
    Tick before = windows_.newest();
    if (most == 0 || steps.tick(most * kBlock - 1) - before <= kRest) { return most; }
    for (std::size_t i = 0; i < most * kBlock; ++i) {
        if (steps.tick(i) - before > kRest) { return i / kBlock; }
        before = steps.tick(i);
    }
    return most;
}

void SpeedMeter::measure_block(Block& measured, StepRates* rates) {
    windows_.measure(measured_until_, direction_, measured, rates);
    measured_until_ += kBlock;
    peak_speed_ = std::max({peak_speed_, measured.speed.highest, -measured.speed.lowest});
    peak_acceleration_ = std::max({peak_acceleration_, measured.acceleration.highest, -measured.acceleration.lowest});
    acceleration_ = measured.acceleration[kBlock - 1];
}

}  // namespace lockstep::analysis
