#include "core/arc_path.hpp"

#include <algorithm>
#include <cmath>
#include <numbers>
#include <utility>

#include "core/number_text.hpp"

namespace lockstep {
namespace {

constexpr double kQuarterTurn = std::numbers::pi / 2;
constexpr double kWhole = 2 * std::numbers::pi;
// An arc with closer ends is a whole turn, as in core/path/geometry/arc_sweep.cpp.
constexpr double kSameAngle = 1e-9;  // rad
constexpr double kMostChords = 100'000;
constexpr double kWithRounding = 1 + 1e-6;
constexpr double kMostErrors = 100;  // in ArcTolerance::error_mm: the greatest difference of an arc's radii

/// Faster than std::hypot, which also takes numbers whose squares are out of range.
double length_of(double x, double y) { return std::sqrt(x * x + y * y); }

double in_micrometres(double mm) { return std::round(mm * 1e4) / 1e4; }

}  // namespace

ArcPath::ArcPath(const ArcShape& shape, std::span<const double> from_mm, std::span<const double> to_mm)
    : shape_(shape), from_(from_mm), to_(to_mm) {
    const auto [first, second] = std::pair(shape.first, shape.second);
    const double from_x = from_[first] - shape.centre_first_mm;
    const double from_y = from_[second] - shape.centre_second_mm;
    const double to_x = to_[first] - shape.centre_first_mm;
    const double to_y = to_[second] - shape.centre_second_mm;
    radius_begin_ = length_of(from_x, from_y);
    radius_end_ = length_of(to_x, to_y);
    begin_ = std::atan2(from_y, from_x);
    double part = std::atan2(to_y, to_x) - begin_;
    if (shape.is_clockwise) { part = -part; }
    if (part < 0) { part += kWhole; }
    if (part <= kSameAngle || part >= kWhole - kSameAngle) { part = kWhole; }
    sweep_ = part + kWhole * (shape.turns - 1);
}

double ArcPath::length_mm() const {
    const double way = sweep_ * (radius_begin_ + radius_end_) / 2;
    const double change = radius_end_ - radius_begin_;
    double square = way * way + change * change;
    for (std::size_t i = 0; i < from_.size(); ++i) {
        if (i != shape_.first && i != shape_.second) { square += (to_[i] - from_[i]) * (to_[i] - from_[i]); }
    }
    return std::sqrt(square);
}

ArcPath::Point::Point(const ArcPath& arc, double share)
    : arc_(&arc),
      share_(share),
      radius_(arc.radius_at(share)),
      cosine_(std::cos(arc.angle_at(share))),
      sine_(std::sin(arc.angle_at(share))) {}

double ArcPath::Point::at(std::size_t axis) const {
    const ArcShape& shape = arc_->shape_;
    if (axis == shape.first) { return shape.centre_first_mm + radius_ * cosine_; }
    if (axis == shape.second) { return shape.centre_second_mm + radius_ * sine_; }
    return arc_->from_[axis] + (arc_->to_[axis] - arc_->from_[axis]) * share_;
}

double ArcPath::Point::slope(std::size_t axis) const {
    const ArcShape& shape = arc_->shape_;
    if (axis != shape.first && axis != shape.second) { return arc_->to_[axis] - arc_->from_[axis]; }
    const double turn = arc_->turn() * radius_;
    const double change = arc_->radius_end_ - arc_->radius_begin_;
    return axis == shape.first ? change * cosine_ - turn * sine_ : change * sine_ + turn * cosine_;
}

ArcPath::Point ArcPath::point(double share) const { return {*this, share}; }

double ArcPath::at(std::size_t axis, double share) const { return point(share).at(axis); }

std::vector<double> ArcPath::at(double share) const {
    const Point point = this->point(share);
    std::vector<double> place;
    place.reserve(from_.size());
    for (std::size_t i = 0; i < from_.size(); ++i) { place.push_back(point.at(i)); }
    return place;
}

double ArcPath::slope(std::size_t axis, double share) const { return point(share).slope(axis); }

std::pair<double, double> ArcPath::direction(double share) const {
    const Point point = this->point(share);
    const double x = point.slope(shape_.first);
    const double y = point.slope(shape_.second);
    return {x / length_of(x, y), y / length_of(x, y)};
}

/// The share of the angle at which a spiral is farthest in an axis's direction, which it crosses at `angle`; nullopt if
/// that is not on the arc. Each correction is much smaller than the one before, until there is none.
std::optional<double> ArcPath::extreme(double angle) const {
    constexpr int kMostCorrections = 20;
    const double change = radius_end_ - radius_begin_;
    const double crossing = (angle - begin_) / (sign() * sweep_);
    const double most_ahead = std::abs(change) / (sweep_ * std::min(radius_begin_, radius_end_)) / sweep_;
    if (crossing < -kWithRounding * most_ahead || crossing > 1 + kWithRounding * most_ahead) { return std::nullopt; }
    double share = crossing;
    for (int k = 0; k < kMostCorrections && change != 0; ++k) {
        const double ahead = std::atan2(change, sweep_ * radius_at(std::clamp(share, 0.0, 1.0)));
        if (std::exchange(share, crossing + ahead / sweep_) == share) { break; }
    }
    return share < 0 || share > 1 ? std::nullopt : std::optional(share);
}

/// The extremes are at the ends, or where the arc crosses the axis's direction from the centre. It is enough to look at
/// the first and the last turn.
std::pair<double, double> ArcPath::extent(std::size_t axis) const {
    double least = std::min(from_[axis], to_[axis]);
    double greatest = std::max(from_[axis], to_[axis]);
    if (axis != shape_.first && axis != shape_.second) { return {least, greatest}; }
    const double turn = sign() * kQuarterTurn;
    const double offset = axis == shape_.first ? 0 : kQuarterTurn;
    const double first = std::ceil((begin_ - offset) / turn);
    const auto note = [&](double crossing) {
        const auto share = extreme(crossing * turn + offset);
        if (!share) { return; }
        const double place = at(axis, *share);
        least = std::min(least, place);
        greatest = std::max(greatest, place);
    };
    const double last = first + std::floor(sweep_ / kQuarterTurn);
    for (int k = -1; k <= 4; ++k) {
        note(first + k);
        note(last - k);
    }
    return {least, greatest};
}

/// A chord over the angle a deviates from its arc by r (1 - cos(a/2)). A radius that changes by c per rad adds 2 c to
/// r.
void ArcPath::each_chord(double tolerance_mm,
                         const std::function<void(const std::vector<double>& to_mm)>& visit) const {
    const double change = std::abs(radius_end_ - radius_begin_) / sweep_;
    const double radius = std::max({radius_begin_, radius_end_, kWidestArc.least_radius_mm}) + 2 * change;
    const double share = std::clamp(1 - tolerance_mm / radius, 0.0, 1 - 1e-15);
    const double chords = std::clamp(std::ceil(sweep_ / (2 * std::acos(share))), 1.0, kMostChords);
    for (std::int64_t k = 1; k < static_cast<std::int64_t>(chords); ++k) { visit(at(static_cast<double>(k) / chords)); }
    visit({to_.begin(), to_.end()});
}

std::string why_no_arc(double begin, double end, const ArcTolerance& tolerance) {
    if (!(std::min(begin, end) >= tolerance.least_radius_mm)) {
        return "has a radius of " + number_text(std::min(begin, end)) + " mm, which must be at least " +
               number_text(tolerance.least_radius_mm) + " mm; its centre is where it starts or ends";
    }
    const double error = std::abs(begin - end);
    const bool is_far = error > tolerance.share * std::max(begin, end);
    const double most = kMostErrors * tolerance.error_mm;
    if (error <= most && (error <= tolerance.error_mm || !is_far)) { return {}; }
    const double share_mm = std::min(tolerance.share * std::max(begin, end), most);
    return "does not close: its radius is " + number_text(begin) + " mm at the start and " + number_text(end) +
           " mm at the end, which may differ by " +
           number_text(in_micrometres(std::max(tolerance.error_mm, share_mm))) + " mm; correct the centre or the end";
}

void each_chord(const ProgramMove& move, std::span<const double> from_mm, double tolerance_mm,
                const std::function<void(const std::vector<double>& to_mm)>& visit) {
    if (!move.arc) { return visit(move.target_mm); }
    ArcPath(*move.arc, from_mm, move.target_mm).each_chord(tolerance_mm, visit);
}

double length_mm(const ProgramMove& move, std::span<const double> from_mm) {
    if (move.arc) { return ArcPath(*move.arc, from_mm, move.target_mm).length_mm(); }
    double square = 0;
    for (std::size_t i = 0; i < from_mm.size(); ++i) {
        square += (move.target_mm[i] - from_mm[i]) * (move.target_mm[i] - from_mm[i]);
    }
    return std::sqrt(square);
}

}  // namespace lockstep
