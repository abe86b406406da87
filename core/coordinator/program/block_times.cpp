#include "core/coordinator/program/block_times.hpp"

#include <algorithm>
#include <cmath>

#include "core/check.hpp"

namespace lockstep {
namespace {

constexpr double kSharp = 0.94;  // cosine of an angle: core/path keeps corners with greater angles

}  // namespace

BlockTimes::BlockTimes(const MachineConfig& machine) : direction_(machine.axes.size(), 0.0) {
    for (const AxisConfig& axis : machine.axes) {
        max_velocity_mm_s_.push_back(axis.max_velocity_mm_s);
        acceleration_mm_s2_.push_back(std::min(axis.max_accel_mm_s2, axis.max_decel_mm_s2));
    }
}

void BlockTimes::add_move(std::span<const double> way_mm, std::optional<double> feed_mm_s) {
    double square = 0;
    for (const double way : way_mm) { square += way * way; }
    Way way{.length_mm = std::sqrt(square),
            .speed_mm_s = feed_mm_s.value_or(kMaxFeed_mm_s),
            .acceleration_mm_s2 = kMaxFeed_mm_s};
    if (way.length_mm <= 0) { return add(0, 0); }
    std::vector<double> direction(way_mm.begin(), way_mm.end());
    for (std::size_t i = 0; i < way_mm.size(); ++i) {
        direction[i] /= way.length_mm;
        const double share = std::abs(direction[i]);
        if (share <= 0) { continue; }
        way.speed_mm_s = std::min(way.speed_mm_s, max_velocity_mm_s_[i] / share);
        way.acceleration_mm_s2 = std::min(way.acceleration_mm_s2, acceleration_mm_s2_[i] / share);
    }
    add_way(way, direction, direction);
}

/// The arc is assumed as fast as its curvature and the slower axis of its plane allow everywhere.
void BlockTimes::add_arc(const ArcPath& arc, std::pair<std::size_t, std::size_t> plane, std::span<const double> way_mm,
                         std::optional<double> feed_mm_s) {
    const auto [first, second] = plane;
    check(first < way_mm.size() && second < way_mm.size(), "an arc is in the plane of two axes");
    const double length = arc.length_mm();
    const double in_plane = arc.plane_length_mm() / length;
    Way way{.length_mm = length, .speed_mm_s = feed_mm_s.value_or(kMaxFeed_mm_s), .acceleration_mm_s2 = 0};
    way.acceleration_mm_s2 = std::min(acceleration_mm_s2_[first], acceleration_mm_s2_[second]);
    const double radius = std::min(arc.radius_begin(), arc.radius_end());
    way.speed_mm_s = std::min({way.speed_mm_s, max_velocity_mm_s_[first] / in_plane,
                               max_velocity_mm_s_[second] / in_plane, std::sqrt(way.acceleration_mm_s2 * radius)});
    std::vector<double> begins(way_mm.begin(), way_mm.end());
    for (std::size_t i = 0; i < way_mm.size(); ++i) {
        begins[i] /= length;
        const double share = std::abs(begins[i]);
        if (i == first || i == second || share <= 0) { continue; }
        way.speed_mm_s = std::min(way.speed_mm_s, max_velocity_mm_s_[i] / share);
    }
    std::vector<double> ends = begins;
    const auto set_direction = [&](std::vector<double>& direction, double share) {
        const auto [x, y] = arc.direction(share);
        direction[first] = in_plane * x;  // NOLINT(clang-analyzer-core.NullDereference): see check
        direction[second] = in_plane * y;
    };
    set_direction(begins, 0);
    set_direction(ends, 1);
    add_way(way, begins, std::move(ends));
}

/// `begins` and `ends`: directions, each of length 1.
void BlockTimes::add_way(const Way& way, const std::vector<double>& begins, std::vector<double> ends) {
    double cosine = 0;
    for (std::size_t i = 0; i < begins.size(); ++i) { cosine += begins[i] * direction_[i]; }
    if (cosine < kSharp) { close_run(); }
    if (run_s_ <= 0) { run_acceleration_ = way.acceleration_mm_s2; }
    direction_ = std::move(ends);
    run_s_ += way.length_mm / way.speed_mm_s;
    run_mm_ += way.length_mm;
    add(way.length_mm / way.speed_mm_s, way.length_mm);
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

/// The motion is assumed from rest to rest with the mean of the speeds asked for, or slower if the distance is too
/// short to reach it.
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
