#include "core/coordinator/path/leg_times.hpp"

#include <algorithm>
#include <cmath>

namespace lockstep {
namespace {

constexpr double kSharp = 0.94;  // cosine of an angle: core/path keeps greater ones as corners

}  // namespace

LegTimes::LegTimes(const MachineConfig& machine, std::uint32_t first)
    : first_(first), direction_(machine.axes.size(), 0.0) {
    for (const AxisConfig& axis : machine.axes) {
        max_velocity_mm_s_.push_back(axis.max_velocity_mm_s);
        acceleration_mm_s2_.push_back(std::min(axis.max_accel_mm_s2, axis.max_decel_mm_s2));
    }
}

void LegTimes::add_move(std::span<const double> way_mm, double feed_mm_s) {
    double square = 0;
    for (const double way : way_mm) { square += way * way; }
    const double length = std::sqrt(square);
    if (length <= 0) { return add_rest(0); }
    double speed = feed_mm_s > 0 ? feed_mm_s : kMaxFeed_mm_s;
    double acceleration = kMaxFeed_mm_s;
    double cosine = 0;
    for (std::size_t i = 0; i < way_mm.size(); ++i) {
        const double share = std::abs(way_mm[i]) / length;
        cosine += way_mm[i] / length * direction_[i];
        if (share <= 0) { continue; }
        speed = std::min(speed, max_velocity_mm_s_[i] / share);
        acceleration = std::min(acceleration, acceleration_mm_s2_[i] / share);
    }
    if (cosine < kSharp) { close_run(); }
    if (run_s_ <= 0) { run_acceleration_ = acceleration; }
    for (std::size_t i = 0; i < way_mm.size(); ++i) { direction_[i] = way_mm[i] / length; }
    run_s_ += length / speed;
    run_mm_ += length;
    blocks_.push_back({static_cast<float>(length / speed), static_cast<float>(length)});
}

void LegTimes::add_rest(double seconds) {
    if (seconds > 0) { close_run(); }
    blocks_.push_back({static_cast<float>(seconds), 0});
    if (seconds > 0) { run_ = blocks_.size(); }
}

/// From rest to rest with the mean of the speeds asked for, or as fast as the way to it allows.
void LegTimes::close_run() {
    if (run_s_ > 0) {
        const double speed = run_mm_ / run_s_;
        const bool is_reached = run_mm_ >= speed * speed / run_acceleration_;
        const double seconds =
            is_reached ? run_s_ + speed / run_acceleration_ : 2 * std::sqrt(run_mm_ / run_acceleration_);
        for (std::size_t k = run_; k < blocks_.size(); ++k) {
            blocks_[k].end_s *= static_cast<float>(seconds / run_s_);
        }
    }
    run_ = blocks_.size();
    run_s_ = run_mm_ = 0;
}

void LegTimes::finish() {
    close_run();
    double seconds = 0;
    for (BlockTime& block : blocks_) {
        seconds += static_cast<double>(block.end_s);
        block.end_s = static_cast<float>(seconds);
    }
}

double LegTimes::seconds_from(const PathPlace& place) const {
    const std::size_t k = place.block < first_ ? 0 : place.block - first_;
    if (k >= blocks_.size()) { return 0; }
    const double begin = k == 0 ? 0 : static_cast<double>(blocks_[k - 1].end_s);
    const double length = static_cast<double>(blocks_[k].length_mm);
    const double share = length > 0 ? std::clamp(place.along.as_steps() / length, 0.0, 1.0) : 0;
    return seconds() - begin - share * (static_cast<double>(blocks_[k].end_s) - begin);
}

}  // namespace lockstep
