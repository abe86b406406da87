#include "core/coordinator/program/block_times.hpp"

#include <algorithm>
#include <cmath>

namespace lockstep {
namespace {

constexpr double kSharp = 0.94;  // cosine of an angle: core/path keeps greater ones as corners

}  // namespace

BlockTimes::BlockTimes(const MachineConfig& machine) : direction_(machine.axes.size(), 0.0) {
    for (const AxisConfig& axis : machine.axes) {
        max_velocity_mm_s_.push_back(axis.max_velocity_mm_s);
        acceleration_mm_s2_.push_back(std::min(axis.max_accel_mm_s2, axis.max_decel_mm_s2));
    }
}

void BlockTimes::add_move(std::span<const double> way_mm, double feed_mm_s) {
    double square = 0;
    for (const double way : way_mm) { square += way * way; }
    const double length = std::sqrt(square);
    if (length <= 0) { return add(0, 0); }
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
    add(length / speed, length);
}

void BlockTimes::add_dwell(double seconds) {
    if (seconds > 0) { close_run(); }
    add(seconds, 0);
    if (seconds > 0) { close_run(); }
}

void BlockTimes::add_rest() {
    close_run();
    add(0, 0);
    close_run();
}

void BlockTimes::add(double seconds, double length_mm) {
    const double end_s = this->seconds() + seconds;
    if (blocks_++ % stride_ != 0) {
        marks_.back() = {end_s, 0};
        return;
    }
    marks_.push_back({end_s, stride_ == 1 ? length_mm : 0});
    if (marks_.size() == kMostMarks) { halve(); }
}

void BlockTimes::halve() {
    for (std::size_t k = 0; 2 * k + 1 < marks_.size(); ++k) { marks_[k] = {marks_[2 * k + 1].end_s, 0}; }
    marks_.resize(marks_.size() / 2);
    run_ /= 2;
    stride_ *= 2;
}

/// From rest to rest with the mean of the speeds asked for, or as fast as the way to it allows.
void BlockTimes::close_run() {
    if (run_s_ > 0) {
        const double speed = run_mm_ / run_s_;
        const bool is_reached = run_mm_ >= speed * speed / run_acceleration_;
        const double seconds =
            is_reached ? run_s_ + speed / run_acceleration_ : 2 * std::sqrt(run_mm_ / run_acceleration_);
        for (std::size_t k = run_; k < marks_.size(); ++k) {
            const double into = std::max(0.0, marks_[k].end_s - run_begin_s_);
            marks_[k].end_s = std::min(marks_[k].end_s, run_begin_s_) + into * seconds / run_s_;
        }
    }
    const bool is_mark_full = blocks_ % stride_ == 0;
    run_ = marks_.size() - (is_mark_full || marks_.empty() ? 0 : 1);
    run_begin_s_ = seconds();
    run_s_ = run_mm_ = 0;
}

double BlockTimes::seconds_from(const PathPlace& place) const {
    const std::size_t k = place.block / stride_;
    if (place.block >= blocks_ || k >= marks_.size()) { return 0; }
    const double begin = k == 0 ? 0 : marks_[k - 1].end_s;
    const double length = marks_[k].length_mm;
    const double along = length > 0 ? place.along.as_steps() / length : 0;
    const double share = (static_cast<double>(place.block % stride_) + std::clamp(along, 0.0, 1.0)) /
                         static_cast<double>(std::min(stride_, blocks_ - k * stride_));
    return seconds() - begin - share * (marks_[k].end_s - begin);
}

}  // namespace lockstep
