#include "core/path/timing/path_timer.hpp"

#include <algorithm>
#include <cmath>

#include "core/path/timed_path.hpp"

namespace lockstep {
namespace {

constexpr double kSameSpeed = 1e-8;  // of the speed: turns that begin and end so near to each other's speed repeat

}  // namespace

void PathTimer::begin(std::span<const Position> at, const Overrides& overrides, PathLoad& load) {
    geometry_.begin(at);
    window_.restart(overrides, {});
    load_ = &load;
    load_->begin();
    passed_on_ = next_ = piece_ = 0;
    has_begun_ = false;
    w_ = v_ = ticks_ = 0;
    turns_.clear();
}

void PathTimer::pass_arc() {
    turns_.clear();
    while (geometry_.turns_that_repeat() > 0) {
        cut_turn();
        skip_turns();
    }
    turns_.clear();
    do {
        if (geometry_.has_more()) { geometry_.cut_on(); }
        pass_on();
    } while (geometry_.has_more());
}

void PathTimer::end() {
    window_.finish();
    pass_known();
    load_->end(v_);
}

void PathTimer::pass_on() {
    const std::size_t ready = geometry_.ready();
    if (passed_on_ == ready) { return; }
    for (; passed_on_ < ready; ++passed_on_) { window_.add(geometry_.trail().piece(passed_on_)); }
    geometry_.drop_before(ready);
    pass_known();
}

/// Passes the intervals with final ends.
void PathTimer::pass_known() {
    const std::size_t known = window_.known();
    if (next_ >= known) { return; }
    if (!has_begun_) {
        w_ = window_.interval(next_).reach;
        v_ = std::sqrt(w_);
        has_begun_ = true;
    }
    IntervalBounds bounds = window_.bounds(window_.interval(next_));
    for (; next_ < known; ++next_) {
        const Interval& part = window_.interval(next_);
        const double w1 = speed_behind(part, bounds);
        const bool cruises = part.kind == IntervalKind::Curved && w1 == w_;
        cruises ? pass(cruise(part, known), w1) : pass(part, w1);
    }
    window_.drop_before(next_);
}

/// The square of the speed at the end of the next interval. Only a faster end depends on its bounds.
double PathTimer::speed_behind(const Interval& part, IntervalBounds& bounds) const {
    const double reach = window_.reach_behind(next_);
    if (reach <= w_ && part.kind == IntervalKind::Curved) { return reach; }
    bounds.take(window_.piece_of(part), part);
    return std::min(reach, bounds.after(w_));
}

/// An interval together with those behind it on the same piece that are passed at the same speed.
Interval PathTimer::cruise(const Interval& part, std::size_t known) {
    Interval whole = part;
    while (next_ + 1 < known && window_.interval(next_ + 1).piece == part.piece &&
           window_.reach_behind(next_ + 1) == w_) {
        whole.to = window_.interval(++next_).to;
    }
    return whole;
}

void PathTimer::pass(const Interval& part, double w1) {
    const bool is_first = part.piece >= piece_;
    piece_ = part.piece + 1;
    if (is_first && !turns_.empty()) { note_turn(); }
    const JoinedPiece& piece = window_.piece_of(part);
    const double v1 = w1 == w_ ? v_ : std::sqrt(w1);
    PassedInterval passed{.piece = piece, .part = part, .v0 = v_, .v1 = v1, .top = std::max(v_, v1)};
    switch (part.kind) {
        case IntervalKind::Rest: ticks_ += static_cast<double>(piece.shape.rest.value); break;
        case IntervalKind::Curved: ticks_ += ticks_over(part.length(), passed.v0, passed.v1); break;
        case IntervalKind::Straight: {
            const StraightPassage straight(part, w_, w1);
            passed.top = std::sqrt(straight.top);
            ticks_ += ticks_over(straight.rise, passed.v0, passed.top) +
                      ticks_over(part.length() - straight.rise - straight.fall, passed.top, passed.top) +
                      ticks_over(straight.fall, passed.top, passed.v1);
            break;
        }
    }
    load_->pass(passed, is_first);
    w_ = w1;
    v_ = passed.v1;
}

/// A piece begins, which may be the first one of a turn.
void PathTimer::note_turn() {
    const auto turn = std::ranges::find_if(turns_, [&](const Turn& t) { return !t.is_passed; });
    if (turn == turns_.end() || turn->piece + 1 != piece_) { return; }
    const ArcShape& arc = geometry_.arc();
    *turn = {.piece = turn->piece,
             .is_passed = true,
             .ticks = ticks_,
             .v = v_,
             .first_steps = load_->axes()[arc.first].steps,
             .second_steps = load_->axes()[arc.second].steps};
    if (turn - turns_.begin() > 1) { turns_.pop_front(); }
}

void PathTimer::cut_turn() {
    turns_.push_back({.piece = geometry_.trail().end()});
    constexpr int kQuarters = 4;
    for (int k = 0; k < kQuarters; ++k) { geometry_.cut_on(); }
    pass_on();
}

/// If a turn was passed that begins and ends at the same speed, those behind the known ones are like it, except the
/// last ones: as many as wait for their speeds, and one more.
void PathTimer::skip_turns() {
    if (turns_.size() < 2 || !turns_[1].is_passed) { return; }
    const Turn& begin = turns_[0];
    const Turn& end = turns_[1];
    const auto waiting = static_cast<int>(turns_.size());
    const int turns = geometry_.turns_that_repeat() - waiting;
    if (turns <= 0 || std::abs(end.v - begin.v) > kSameSpeed * end.v) { return; }
    ticks_ += turns * (end.ticks - begin.ticks);
    load_->add_steps(RowIndex{geometry_.arc().first}, turns * (end.first_steps - begin.first_steps));
    load_->add_steps(RowIndex{geometry_.arc().second}, turns * (end.second_steps - begin.second_steps));
    geometry_.skip_turns(turns);
}

}  // namespace lockstep
