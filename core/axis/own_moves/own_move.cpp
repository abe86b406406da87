#include "core/axis/own_moves/own_move.hpp"

#include <algorithm>
#include <cmath>

#include "core/motion/interpolate.hpp"

namespace lockstep {
namespace {

/// A forward motion that brakes from a place and speed of the move to rest.
struct Brake {
    Displacement to;
    double entry = 0;  // steps per tick
    double exit = 0;

    double ticks(Displacement from) const { return std::ceil(2 * (to - from).as_steps() / (entry + exit)); }
};

/// Plans to rest between two steps, from the speed that the axis can drop suddenly.
Brake plan_soonest_brake(Displacement from, double speed, double jump, std::int64_t last_step,
                         const AxisLimits& limits) {
    Brake brake{.to = from, .entry = speed, .exit = std::min(speed, jump)};
    const double way = (speed * speed - brake.exit * brake.exit) / (2 * limits.max_deceleration);
    brake.to =
        std::min(Displacement{from.raw + static_cast<Int128>(std::ceil(way * 0x1p64))}, Displacement::steps(last_step));
    return brake;
}

/// Plans to rest on the first whole step that can be reached, but never beyond the move's last step. If there is enough
/// distance, the speed falls at the end from half of the start velocity to 0. The other half is left for uneven pulses
/// of a method. Near its last step a move is planned to slow down to the start velocity only. There the final speed
/// follows from the distance s that remains: its square is v^2 - 2 d s, and it is at most the start velocity. If the
/// speed is still too high, because a method rounds, it first drops suddenly, within the start velocity. `jump`: what
/// the method's pulses have left of the start velocity.
Brake plan_whole_brake(Displacement from, double speed, double jump, std::int64_t last_step, const AxisLimits& limits) {
    const double d = limits.max_deceleration;
    Brake brake{.entry = speed, .exit = std::min({speed, limits.start_velocity / 2, jump})};
    const double way = (speed * speed - brake.exit * brake.exit) / (2 * d) + 2 * speed;  // not shorter than two ticks
    const Int128 end = from.raw + static_cast<Int128>(std::ceil(way * 0x1p64));
    const Int128 whole = (end + kOneStep - 1) / kOneStep * kOneStep;
    brake.to = std::min(Displacement{whole}, Displacement::steps(last_step));
    const double left = std::max(0.0, (brake.to - from).as_steps());
    const double needed = std::sqrt(std::max(0.0, speed * speed - 2 * d * left));
    if (needed <= jump) { brake.exit = std::max(brake.exit, needed); }
    const double steepest = std::sqrt(brake.exit * brake.exit + 2 * d * left);
    brake.entry = std::min(speed, std::max(steepest, speed - jump));
    return brake;
}

Brake plan_brake(Displacement from, double speed, double jumped, std::int64_t last_step, Ticks most_longer,
                 const AxisLimits& limits) {
    const double jump = std::max(0.0, limits.start_velocity - jumped);
    const Brake whole = plan_whole_brake(from, speed, jump, last_step, limits);
    const Brake soonest = plan_soonest_brake(from, speed, jump, last_step, limits);
    const bool is_soon = whole.ticks(from) <= soonest.ticks(from) + static_cast<double>(most_longer.value);
    return is_soon ? whole : soonest;
}

}  // namespace

OwnMove::OwnMove(OwnPieces pieces, const Place& place, const AxisLimits& limits, Ticks span)
    : pieces_(std::move(pieces)), place_(place), limits_(limits), span_(span), end_(place.start), at_(place.from) {}

HeldFrame OwnMove::next() {
    HeldFrame frame{.number = ++made_, .start = end_};
    frame.track.from = at_;
    fill_body(frame);
    frame.last = pieces_.done();
    if (!frame.last) { fill_tail(frame); }
    end_ = frame.end();
    at_ = frame.body_end();
    return frame;
}

void OwnMove::fill_body(HeldFrame& frame) {
    while (frame.ticks < span_ && !frame.track.body.full()) {
        const auto piece = pieces_.next(span_);
        if (!piece) { return; }
        frame.track.body.append(directed(*piece));
        frame.ticks += piece->ticks;
        gone_ = gone_ + piece->covered();
        const double a = piece->acceleration.steps_per_tick2();
        fastest_ -= limits_.max_deceleration * static_cast<double>(piece->ticks.value);
        speed_ = piece->velocity.steps_per_tick() + a * (static_cast<double>(piece->ticks.value) + 0.5);
        fastest_ = std::max(fastest_, speed_);
    }
}

/// The tail is one piece of constant deceleration. Its ticks are rounded up, and its velocity is solved for the exact
/// end.
void OwnMove::fill_tail(HeldFrame& frame) const {
    const Brake brake = plan_brake(gone_, speed_, fastest_ - speed_, place_.steps, span_ * kTailFrames, limits_);
    const Displacement way = brake.to - gone_;
    if (way.raw <= 0) { return; }
    const double ticks = brake.ticks(gone_);
    const Piece piece = solve_piece(Position{}, Position{way.raw}, {static_cast<std::int64_t>(ticks)},
                                    (brake.exit - brake.entry) / ticks);
    frame.track.tail.append(directed(piece));
}

/// Backward motion is the exact mirror of forward motion.
Piece OwnMove::directed(const Piece& piece) const {
    if (!place_.backward) { return piece; }
    return {piece.ticks, {-piece.velocity.raw}, {-piece.acceleration.raw}};
}

}  // namespace lockstep
