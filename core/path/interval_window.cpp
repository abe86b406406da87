#include "core/path/interval_window.hpp"

#include <algorithm>
#include <cmath>
#include <cstdint>

#include "core/path/piece_joints.hpp"

namespace lockstep {
namespace {

constexpr double kRounding = 1e-11;  // of w: far more than the rounding of a backward pass

}  // namespace

void IntervalWindow::clear(std::size_t first_piece) {
    first_piece_ = first_piece;
    pieces_.clear();
    intervals_.clear();
    first_ = final_ = 0;
    is_open_ = is_finished_ = false;
    due_ = kLeastPass;
    end_cap_ = 0;
}

std::size_t IntervalWindow::interval_at(std::size_t piece, double u) const {
    std::size_t low = first_;
    std::size_t high = end();
    while (high - low > 1) {
        const std::size_t middle = (low + high) / 2;
        const Interval& part = interval(middle);
        const bool is_behind = part.piece > piece || (part.piece == piece && part.from > u);
        (is_behind ? high : low) = middle;
    }
    return low;
}

double IntervalWindow::reach_behind(std::size_t number) const {
    if (number + 1 < end()) { return interval(number + 1).reach; }
    return is_finished_ ? std::min(end_cap_, interval(number).top) : 0;
}

std::size_t IntervalWindow::known() const {
    if (is_finished_) { return end(); }
    return final_ > first_ ? final_ - 1 : first_;
}

/// An interval that may cruise can keep the speed of its end, so its bounds matter only if that is below its cap. A
/// reach that differs from the cap only by rounding is set to the cap, because whether a place is final must not depend
/// on where the pass began.
void IntervalWindow::update(std::size_t first, std::size_t last) {
    double behind = reach_behind(last);
    IntervalBounds bounds = this->bounds(interval(last));
    for (std::size_t k = last + 1; k-- > first; behind = interval(k).reach) {
        Interval& part = intervals_[k - first_];
        if (part.may_cruise && behind >= part.cap) {
            part.reach = part.cap;
            continue;
        }
        bounds.take(piece_of(part), part);
        const double reach = bounds.before(behind);
        part.reach = reach < (1 - kRounding) * part.cap ? reach : part.cap;
    }
}

/// If the reach of a place is the cap of its own limits, it does not depend on later pieces.
void IntervalWindow::look_ahead() {
    if (final_ < end()) { update(final_, end() - 1); }
    std::size_t last = end();
    while (last > final_ && interval(last - 1).reach < interval(last - 1).cap) { --last; }
    if (end() - last >= kMaxOpen) { last = end() - kMaxOpen / 2; }
    final_ = last;
    due_ = std::max(2 * (end() - final_), kLeastPass);
}

void IntervalWindow::cut(std::size_t number, double u, double w) {
    Interval& part = intervals_[number - first_];
    part.from = u;
    part.cap = part.reach = w;
    part.jump = 0;
    part.joint = PieceJoints::kMost;
}

void IntervalWindow::lower(std::size_t number, double cap) {
    if (number == end()) {
        end_cap_ = std::min(end_cap_, cap);
    } else {
        Interval& part = intervals_[number - first_];
        part.cap = std::min(part.cap, cap);
    }
}

void IntervalWindow::slow(std::size_t number, double slower, Ticks enough) {
    Interval& part = intervals_[number - first_];
    if (part.kind == IntervalKind::Straight) { part.top *= slower; }
    if (part.kind != IntervalKind::Rest) { return; }
    Ticks& rest = pieces_[part.piece - first_piece_].shape.rest;
    const double longer = std::ceil(static_cast<double>(rest.value) / slower);
    if (rest < enough) { rest = std::min(enough, Ticks{static_cast<std::int64_t>(longer)}); }
}

void IntervalWindow::drop_before(std::size_t number) {
    const std::size_t piece =
        number < end() ? interval(number).piece : first_piece_ + pieces_.size() - (is_open_ ? 1 : 0);
    intervals_.drop_front(number - first_);
    while (first_piece_ + 1 < piece) {  // may_rise looks back at the piece before
        pieces_.pop_front();
        ++first_piece_;
    }
    first_ = number;
    final_ = std::max(final_, first_);
}

}  // namespace lockstep
