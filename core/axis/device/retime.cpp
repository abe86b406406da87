#include "core/axis/device/retime.hpp"

#include <algorithm>
#include <cmath>

namespace lockstep {
namespace {

Int128 rounded_quotient(Int128 value, Int128 by) {
    const Int128 half = by / 2;
    return (value >= 0 ? value + half : value - half) / by;
}

/// Converts times of a stretch from machine time to the device's clock. `gone`: machine ticks since its start, with a
/// fraction.
class Pace {
public:
    Pace(Ticks machine, const Retiming& when)
        : machine_(static_cast<double>(machine.value)),
          mean_(static_cast<double>((when.end - when.start).value) / machine_),
          bend_(when.bend) {}

    double device_at(double gone) const { return gone * mean_ * (1 - bend_ * (1 - gone / machine_)); }
    /// Device ticks per machine tick, and how fast that changes.
    double rate_at(double gone) const { return mean_ * (1 - bend_ + 2 * bend_ * gone / machine_); }
    double change() const { return mean_ * 2 * bend_ / machine_; }
    /// By how much of a machine tick `device` is later than `gone`.
    double late(Ticks device, double gone) const {
        return std::clamp((static_cast<double>(device.value) - device_at(gone)) / rate_at(gone), -0.5, 0.5);
    }

private:
    double machine_;
    double mean_;  // device ticks per machine tick
    double bend_;
};

/// The speed of the motion where two pieces join: the lower one of both, or 0 if the motion reverses there. So a tick
/// of this speed more or less is at most a tick of either piece.
double joint_speed(const Piece& before, const Piece& after) {
    const double ends =
        static_cast<double>(before.velocity_after(before.ticks)) + static_cast<double>(before.acceleration.raw) / 2;
    const double begins = static_cast<double>(after.velocity.raw) + static_cast<double>(after.acceleration.raw) / 2;
    if (ends * begins <= 0) { return 0; }
    return std::abs(ends) < std::abs(begins) ? ends : begins;
}

/// Returns a piece of `ticks` device ticks that covers `covers`, except for a rounding error below `ticks`. Its
/// acceleration is the derivative of v / rate by the device's clock, in the middle of the piece: a / rate^2 - v rate' /
/// rate^3.
Piece solved(const Piece& piece, double begun, const Pace& pace, Displacement covers, Ticks ticks) {
    const double rate = pace.rate_at(begun + static_cast<double>(piece.ticks.value) / 2);
    const double speed = static_cast<double>(piece.velocity_after({piece.ticks.value / 2}));
    const auto acceleration = static_cast<double>(piece.acceleration.raw);
    Piece result{ticks, {}, {std::llround((acceleration - speed * pace.change() / rate) / (rate * rate))}};
    result.velocity.raw = static_cast<std::int64_t>(rounded_quotient(covers.raw - result.covered().raw, ticks.value));
    return result;
}

/// A piece of one tick that covers exactly `covers`.
Piece tick_of(Displacement covers) { return {{1}, {static_cast<std::int64_t>(covers.raw)}, {}}; }

}  // namespace

Ticks Retiming::bow() const {
    return {static_cast<std::int64_t>(std::ceil(std::abs(bend) / 4 * static_cast<double>((end - start).value)))};
}

template <std::size_t Capacity>
bool retime(StaticVector<Piece, Capacity>& pieces, const Retiming& when) {
    StaticVector<Piece, Capacity> result;
    const Pace pace(total_ticks(pieces), when);
    Ticks gone;           // duration of the given pieces so far
    Displacement joined;  // the place where these end
    Tick device = when.start;
    Displacement reached;
    bool fits = true;
    for (std::size_t i = 0; i < pieces.size(); ++i) {
        const Piece& piece = pieces[i];
        const auto begun = static_cast<double>(gone.value);
        gone += piece.ticks;
        joined = joined + piece.covered();
        const auto ends = static_cast<double>(gone.value);
        const Ticks needed{static_cast<std::int64_t>(pieces.size() - i) - 1};  // one for each piece that follows
        const bool last = needed == Ticks{};
        const Tick nearest = last ? when.end : when.start + Ticks{std::llround(pace.device_at(ends))};
        const Tick end = std::max(device + Ticks{1}, std::min(nearest, when.end - needed));
        Displacement place = joined;
        if (!last) {
            place.raw += static_cast<Int128>(joint_speed(piece, pieces[i + 1]) * pace.late(end - when.start, ends));
        }
        Piece solution = solved(piece, begun, pace, place - reached, end - device);
        if (last && reached + solution.covered() != place && solution.ticks.value > 1) {
            solution.ticks.value -= 1;
            fits = fits && result.push_back(solution);
            reached = reached + solution.covered();
            solution = tick_of(place - reached);
        }
        fits = fits && result.push_back(solution);
        reached = reached + solution.covered();
        device = end;
    }
    if (fits) { pieces = result; }
    return fits;
}

void retime(OutputChange* changes, std::size_t count, Ticks machine, const Retiming& when) {
    const Pace pace(machine, when);
    for (std::size_t k = 0; k < count; ++k) {
        const auto gone = static_cast<double>(changes[k].at.value);
        changes[k].at = std::clamp(Ticks{std::llround(pace.device_at(gone))}, Ticks{1}, when.end - when.start);
        if (auto* ramp = std::get_if<RampAnalog>(&changes[k].what)) {
            ramp->slope = std::llround(static_cast<double>(ramp->slope) / pace.rate_at(gone));
        }
    }
}

template bool retime(StaticVector<Piece, kMaxBodyPieces + 1>&, const Retiming&);
template bool retime(StaticVector<Piece, kMaxTailPieces + 1>&, const Retiming&);

}  // namespace lockstep
