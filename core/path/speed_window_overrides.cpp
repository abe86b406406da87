// New overrides in the middle of a path. Pieces behind the place from which they hold are limited and cut again, as if
// they had just arrived. If the machine is faster there than the new overrides allow, it brakes as hard as it may.
#include <algorithm>

#include "core/path/speed_window.hpp"

namespace lockstep {
namespace {

constexpr double kHair = 1 + 1e-6;

}  // namespace

OverrideResult SpeedWindow::set_overrides(const Overrides& overrides, std::size_t number, double w) {
    const bool was_finished = is_finished_;
    const std::size_t piece = interval(number).piece;
    overrides_ = overrides;
    is_finished_ = false;
    turn_piece(number);
    recut_behind(piece);
    if (was_finished) { close_end(); }
    rise_at_once(number, w);
    final_ = number + 1;
    const OverrideResult result = allow_braking(number, w);
    if (result != OverrideResult::Taken) { return result; }
    look_ahead();
    if (is_finished_) { final_ = end(); }
    return result;
}

/// Whether a piece in progress can get faster and still recover the jumps at its ends as before.
bool SpeedWindow::may_rise(std::size_t piece) const {
    const std::size_t k = piece - first_piece_;
    const JoinedPiece& begun = pieces_[k];
    JoinedPiece turned = begun;
    Neighbours beside = this->beside(k);
    beside.begin = joints().joint(beside.before, &turned.shape, beside.from);
    beside.end = joint_at_end(k);
    joints().charge(turned, beside);
    const auto is_paid = [&](RowIndex row, const JoinedPiece& as) {
        return as.is_charged && as.charged.begin()[row] != as.shape.bend.begin()[row];
    };
    for (const RowIndex row : row_indices(setup_.rows())) {
        if (is_paid(row, turned) && !is_paid(row, begun)) { return false; }
    }
    return true;
}

/// Applies the overrides to the rest of the piece in which they begin. The joint at its beginning has been passed.
void SpeedWindow::turn_piece(std::size_t number) {
    const std::size_t piece = interval(number).piece;
    if (interval(number).kind == IntervalKind::Rest) { return; }
    const bool rises = may_rise(piece);
    for (std::size_t k = number; k < end() && interval(k).piece == piece; ++k) {
        Interval& part = intervals_[k - first_];
        const double top = bounds(part).cap(overrides_);
        part.top = rises ? top : std::min(top, part.top);
        if (k > number) { part.cap = std::min(part.top, interval(k - 1).top); }
    }
}

void SpeedWindow::recut_behind(std::size_t piece) {
    ahead_.clear();
    while (first_piece_ + pieces_.size() > piece + 1) {
        ahead_.push_back(pieces_.back().shape);
        pieces_.pop_back();
    }
    while (interval(end() - 1).piece > piece) { intervals_.truncate(intervals_.size() - 1); }
    final_ = std::min(final_, end());
    joint_.reset();
    is_open_ = false;
    for (; !ahead_.empty(); ahead_.pop_back()) { add_rows(ahead_.back()); }
}

/// Raises caps and tops for braking from w at the beginning of an interval. An interval that arrives later is limited
/// by the top of the last known one. If that top were raised here, the limit would differ from that of a completely
/// known path. So one more interval must be known.
OverrideResult SpeedWindow::allow_braking(std::size_t number, double w) {
    for (std::size_t k = number; w > 0; ++k) {
        if (k + 1 >= end() && !is_finished_) { return OverrideResult::LacksPath; }
        if (k == end()) { return w <= kHair * end_cap_ ? OverrideResult::Taken : OverrideResult::CannotFollow; }
        Interval& part = intervals_[k - first_];
        const bool is_rest = part.kind == IntervalKind::Rest;
        if (w > kHair * (is_rest ? part.joint : std::min(part.joint, bounds(part).limit()))) {
            return OverrideResult::CannotFollow;
        }
        part.cap = std::max(part.cap, w);
        part.may_cruise = false;
        if (is_rest) { return OverrideResult::Taken; }
        const double behind = bounds(part).least_after(w);
        if (w > part.top && split_change(k, w)) {
            w = interval(k + 1).cap;
        } else {
            part.top = std::max(part.top, part.kind == IntervalKind::Straight ? behind : w);
            w = behind;
        }
    }
    return OverrideResult::Taken;
}

/// A straight interval accelerates by itself.
void SpeedWindow::rise_at_once(std::size_t number, double w) {
    const Interval& part = interval(number);
    if (part.kind == IntervalKind::Curved && kHair * w < part.top) { (void)split_change(number, w); }
}

/// Makes the beginning of an interval, in which the speed changes from w to the interval's top as fast as it may, a
/// separate interval.
bool SpeedWindow::split_change(std::size_t number, double w) {
    Interval& part = intervals_[number - first_];
    const double mm = way_to_top(part, w);
    if (mm >= part.length()) { return false; }
    Interval rest = part;
    rest.from = part.from + mm;
    rest.cap = part.top;
    rest.joint = PieceJoints::kMost;
    rest.jump = 0;
    part.to = rest.from;
    intervals_.insert(number + 1 - first_, rest);
    return true;
}

/// The shortest beginning of an interval in which the speed can change from w to the interval's top; all of it, if none
/// is long enough.
double SpeedWindow::way_to_top(const Interval& part, double w) const {
    constexpr int kHalvings = 48;
    Interval begin = part;
    const IntervalBounds to_here = bounds(begin);
    double least = 0;
    double most = part.length();
    for (int n = 0; n < kHalvings; ++n) {
        const double mm = least + (most - least) / 2;
        begin.to = begin.from + mm;
        const bool is_enough = w > part.top ? to_here.least_after(w) <= part.top : to_here.after(w) >= part.top;
        (is_enough ? most : least) = mm;
    }
    return most;
}

}  // namespace lockstep
