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

    double ticks_over(double steps) const { return 2 * steps / (entry + exit); }
};

/// Plans to rest on the first whole step that can be reached, but never beyond the move's last step. A slow axis would
/// reach it much later than it can brake. If that takes more than `to_whole_step` longer, it rests where it has braked,
/// between two steps. No pulse is missing or left over there, because a pulse is made where the position crosses a
/// half, and the next motion begins on the whole step that was counted last. If there is enough distance, the speed
/// falls at the end from half of the start velocity to 0. The other half is left for uneven pulses of a method. Near
/// its last step a move is planned to slow down to the start velocity only. There the final speed follows from the
/// distance s that remains: its square is v^2 - 2 d s, and it is at most the start velocity. If the speed is still too
/// high, because a method rounds, it first drops suddenly, within the start velocity. `jumped`: the part of the start
/// velocity that the method's pulses have just used up.
Brake plan_brake(Displacement from, double speed, double jumped, std::int64_t last_step, const AxisLimits& limits,
                 Ticks to_whole_step) {
    const double d = limits.max_deceleration;
    const double jump = std::max(0.0, limits.start_velocity - jumped);
    Brake brake{.entry = speed, .exit = std::min({speed, limits.start_velocity / 2, jump})};
    const double way = (speed * speed - brake.exit * brake.exit) / (2 * d) + 2 * speed;  // not shorter than two ticks
    const Int128 end = from.raw + static_cast<Int128>(std::ceil(way * 0x1p64));
    const Int128 whole = (end + kOneStep - 1) / kOneStep * kOneStep;
    brake.to = std::min(Displacement{whole}, Displacement::steps(last_step));
    const Displacement beyond = brake.to - Displacement{end};
    if (brake.ticks_over(beyond.as_steps()) > static_cast<double>(to_whole_step.value)) { brake.to = {end}; }
    const double left = std::max(0.0, (brake.to - from).as_steps());
    const double needed = std::sqrt(std::max(0.0, speed * speed - 2 * d * left));
    if (needed <= jump) { brake.exit = std::max(brake.exit, needed); }
    const double steepest = std::sqrt(brake.exit * brake.exit + 2 * d * left);
    brake.entry = std::min(speed, std::max(steepest, speed - jump));
    return brake;
}

}  // namespace

OwnMove::OwnMove(OwnPieces pieces, const Place& place, const AxisLimits& limits, const Lengths& lengths)
    : pieces_(std::move(pieces)),
      place_(place),
      limits_(limits),
      lengths_(lengths),
      end_(place.start),
      at_(place.from) {}

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
    while (frame.ticks < lengths_.span && frame.track.body.size() < lengths_.body_pieces) {
        const auto piece = pieces_.next(lengths_.span);
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
    const Brake brake = plan_brake(gone_, speed_, fastest_ - speed_, place_.steps, limits_, lengths_.to_whole_step);
    const Displacement way = brake.to - gone_;
    if (way.raw <= 0) { return; }
    const double ticks = std::ceil(brake.ticks_over(way.as_steps()));
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
