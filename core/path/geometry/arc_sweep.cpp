#include "core/path/geometry/arc_sweep.hpp"

#include <utility>

namespace lockstep {
namespace {

constexpr double kSameDirection = 1e-9;  // the sine of an angle: ends of an arc that are closer make a whole circle

/// The angle from a to b, less than a quarter turn. It is halved until the series of the arc sine is exact to 1e-16.
double angle_between(ArcDirection a, ArcDirection b) {
    double scale = 1;
    for (int halvings = 0; halvings < 8; ++halvings, scale *= 2) { b = between(a, b); }
    const double sine = a.cross(b);
    const double square = sine * sine;
    return scale * sine * (1 + square * (1.0 / 6 + square * (3.0 / 40)));
}

/// Whole quarter turns from one direction to the other: 4 if they are the same, otherwise 0 to 3.
int quarters_between(ArcDirection a, ArcDirection b) {
    if (a.dot(b) > 0 && std::abs(a.cross(b)) <= kSameDirection) { return 4; }
    int quarters = 0;
    while (!(a.dot(b) > 0 && a.cross(b) >= -kSameDirection)) {
        a = a.quarter_on();
        ++quarters;
    }
    return quarters;
}

}  // namespace

ArcSweep::ArcSweep(ArcDirection begin, ArcDirection end, int turns) : begin_(begin), end_(end) {
    const int quarters = quarters_between(begin, end);
    part_ = angle_between(begin.turned(quarters), end);
    has_part_ = part_ > kSameDirection;
    ends_whole_ = !has_part_;
    all_ = quarters + 4 * (turns - 1);
    angle_ = all_ * kQuarter + (has_part_ ? part_ : 0);
}

ArcPart ArcSweep::take() {
    const ArcDirection a = begin_.turned(next_);
    if (next_ < all_) {
        const int k = next_++;
        return {a, a.quarter_on(), k * kQuarter, kQuarter, next_ == all_ && ends_whole_};
    }
    has_part_ = false;
    return {a, end_, all_ * kQuarter, part_, true};
}

ArcPart ArcSweep::skip(int turns) {
    next_ += 4 * turns;
    const ArcDirection a = begin_.turned(next_);
    return {a, a, next_ * kQuarter};
}

}  // namespace lockstep
