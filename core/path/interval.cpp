#include "core/path/interval.hpp"

#include <algorithm>
#include <cmath>
#include <limits>
#include <utility>

namespace lockstep {
namespace {

constexpr double kUnbounded = std::numeric_limits<double>::infinity();
constexpr double kCurvedSpeedShare = 0.99;  // of the greatest speed, on curves: room for the fit in time
/// The share of the acceleration that a charge uses at the greatest speed. The rest is for braking: on a long piece the
/// machine comes to rest in at most 4.2 times (atanh of its root) the time that it needs without the charge.
constexpr double kChargedShare = 0.999;

}  // namespace

void IntervalBounds::collect() const {
    if (std::exchange(is_collected_, true)) { return; }
    const JoinedPiece& piece = *piece_;
    rows_.clear();
    bend_limit_.reset();
    for (const RowIndex i : piece.rows& RowSet::first(setup_.rows())) {
        const AxisLimits& limits = setup_.limits[i];
        const double charged = piece.is_charged ? piece.charged.begin()[i] : 0;
        rows_.append({piece.shape.slope.begin()[i], piece.shape.bend.begin()[i], charged, 2 * weaker(limits),
                      limits.max_velocity});
    }
}

/// The greatest w that bends and charges allow.
double IntervalBounds::bend_limit() const {
    collect();
    if (bend_limit_) { return *bend_limit_; }
    double w = kUnbounded;
    for (const Row& row : rows_) {
        const double bend = std::max(std::abs(row.bend), std::abs(row.charged) / kChargedShare);
        if (bend > kNothing) { w = std::min(w, row.twice_weaker / 2 / bend); }
    }
    bend_limit_ = w;
    return w;
}

/// Calls visit(p, q, 2 d a) for each bound |q w1 - p w0| <= 2 d a: at the interval's beginning and end with the axis's
/// own bend, and at its middle with the bend that its joints charge.
template <typename Visit>
void IntervalBounds::each_bound(Visit visit) const {
    collect();
    const double d = interval_->length();
    const double middle = (interval_->from + interval_->to) / 2 - piece_->shape.length / 2;
    const bool is_charged = piece_->is_charged;
    for (const Row& row : rows_) {
        const double slope = row.slope + row.bend * middle;
        const double bend = row.bend * d;
        const double change = d * row.twice_weaker;
        visit(slope - 2.5 * bend, slope - 0.5 * bend, change);
        if (bend != 0) { visit(slope + 0.5 * bend, slope + 2.5 * bend, change); }
        if (is_charged) { visit(slope - row.charged * d, slope + row.charged * d, change); }
    }
}

double IntervalBounds::before(double w1) const {
    if (interval_->kind == IntervalKind::Rest) { return kUnbounded; }
    if (interval_->kind == IntervalKind::Straight) { return w1 + 2 * interval_->deceleration * interval_->length(); }
    double w0 = kUnbounded;
    each_bound([&](double t0, double t1, double change) {
        if (std::abs(t0) < kNothing) { return; }
        w0 = std::min(w0, (change + w1 * (std::copysign(1.0, t0) * t1)) / std::abs(t0));
    });
    return std::max(w0, 0.0);
}

double IntervalBounds::after(double w0) const {
    if (interval_->kind == IntervalKind::Rest) { return kUnbounded; }
    if (interval_->kind == IntervalKind::Straight) { return w0 + 2 * interval_->acceleration * interval_->length(); }
    double w1 = kUnbounded;
    each_bound([&](double t0, double t1, double change) {
        if (std::abs(t1) < kNothing) { return; }
        w1 = std::min(w1, (change + w0 * (std::copysign(1.0, t1) * t0)) / std::abs(t1));
    });
    return std::max(w1, 0.0);
}

double IntervalBounds::least_after(double w0) const {
    if (interval_->kind == IntervalKind::Rest) { return 0; }
    if (interval_->kind == IntervalKind::Straight) { return w0 - 2 * interval_->deceleration * interval_->length(); }
    double w1 = -kUnbounded;
    each_bound([&](double t0, double t1, double change) {
        if (std::abs(t1) < kNothing) { return; }
        w1 = std::max(w1, (w0 * (std::copysign(1.0, t1) * t0) - change) / std::abs(t1));
    });
    return std::min(w1, w0);  // a greater w1 is only rounding, which would grow from interval to interval
}

/// Overrides scale the feed. In rapid moves they scale the speeds that the axes allow, and never exceed these.
double IntervalBounds::cap(const Overrides& overrides) const {
    return std::min(cap_but_speeds(overrides), speed_limit(speed_share(overrides)));
}

std::optional<double> IntervalBounds::common_cap(const Overrides& overrides) const {
    const double w = cap_but_speeds(overrides);
    return speed_limit(speed_share(overrides)) < w ? std::nullopt : std::optional(w);
}

double IntervalBounds::speed_share(const Overrides& overrides) const {
    return piece_->shape.feed_mm_per_tick ? 1 : std::min(1.0, overrides.rapid());
}

/// The greatest w by feed, overrides and bends.
double IntervalBounds::cap_but_speeds(const Overrides& overrides) const {
    const Quadratic& shape = piece_->shape;
    const double w = std::min(bend_limit(), shape.most_mm_per_tick * shape.most_mm_per_tick);
    if (!shape.feed_mm_per_tick) { return w; }
    const double feed = *shape.feed_mm_per_tick * (shape.is_feed_fixed ? 1 : overrides.feed());
    return std::min(w, feed * feed);
}

double IntervalBounds::limit() const { return std::min(speed_limit(1), bend_limit()); }

/// The greatest w at which each axis keeps a share of its greatest speed.
double IntervalBounds::speed_limit(double share) const {
    collect();
    const Quadratic& shape = piece_->shape;
    const double from = interval_->from - shape.length / 2;
    const double to = interval_->to - shape.length / 2;
    const double curved_share = shape.is_straight ? 1 : kCurvedSpeedShare;
    double w = kUnbounded;
    for (const Row& row : rows_) {
        const double slope = std::max(std::abs(row.slope + row.bend * from), std::abs(row.slope + row.bend * to));
        const double speed = row.max_velocity * share * curved_share;
        if (slope > kNothing) { w = std::min(w, speed * speed / (slope * slope)); }
    }
    return w;
}

}  // namespace lockstep
