#include "core/axis/retime.hpp"

#include <algorithm>
#include <cmath>

namespace lockstep {
namespace {

Int128 rounded_quotient(Int128 value, Int128 by) {
    const Int128 half = by / 2;
    return (value >= 0 ? value + half : value - half) / by;
}

/// Ticks of a stretch in machine time (gone since its start, whole or in part) by the device's clock.
class Pace {
public:
    Pace(Ticks machine, const Retiming& when)
        : machine_(static_cast<double>(machine.value)),
          device_(static_cast<double>((when.end - when.start).value)),
          bend_(when.bend) {}

    double device_at(double gone) const {
        const double part = gone / machine_;
        return device_ * part * (1 - bend_ * (1 - part));
    }
    /// Device ticks in a machine tick.
    double rate_at(double gone) const { return device_ / machine_ * (1 - bend_ + 2 * bend_ * gone / machine_); }
    double change() const { return 2 * bend_ * device_ / (machine_ * machine_); }
    /// When the device's clock has gone so far, which is near what it has at `near`.
    double machine_at(Ticks device, double near) const {
        return near + (static_cast<double>(device.value) - device_at(near)) / rate_at(near);
    }

private:
    double machine_;
    double device_;
    double bend_;
};

/// Where the motion of pieces is, between their ticks as well. Asked for times that rise.
template <typename Pieces>
class Motion {
public:
    explicit Motion(const Pieces& pieces) : pieces_(pieces) {}

    Displacement at(double gone) {
        while (piece_ + 1 < pieces_.size() && gone >= begun_ + ticks()) {
            begun_ += ticks();
            covered_ = covered_ + pieces_[piece_].covered();
            ++piece_;
        }
        const double within = std::clamp(gone - begun_, 0.0, ticks());
        const Ticks whole{static_cast<std::int64_t>(within)};
        const double part = within - static_cast<double>(whole.value);
        const double next_tick = static_cast<double>(pieces_[piece_].velocity_after(whole + Ticks{1}));
        return covered_ + pieces_[piece_].covered(whole) + Displacement{static_cast<Int128>(part * next_tick)};
    }

private:
    double ticks() const { return static_cast<double>(pieces_[piece_].ticks.value); }

    const Pieces& pieces_;
    std::size_t piece_ = 0;
    double begun_ = 0;
    Displacement covered_;
};

/// The piece for so many device ticks that covers so much, but for what rounding leaves: less than `ticks`. Its
/// acceleration is that of v / rate by the device's clock, in the middle of the piece: a / rate^2 - v rate' / rate^3.
Piece solved(const Piece& piece, double begun, const Pace& pace, Displacement covers, Ticks ticks) {
    const double rate = pace.rate_at(begun + static_cast<double>(piece.ticks.value) / 2);
    const double speed = static_cast<double>(piece.velocity_after({piece.ticks.value / 2}));
    const auto acceleration = static_cast<double>(piece.acceleration.raw);
    Piece result{ticks, {}, {std::llround((acceleration - speed * pace.change() / rate) / (rate * rate))}};
    result.velocity.raw = static_cast<std::int64_t>(rounded_quotient(covers.raw - result.covered().raw, ticks.value));
    return result;
}

/// One tick that covers just so much.
Piece tick_of(Displacement covers) { return {{1}, {static_cast<std::int64_t>(covers.raw)}, {}}; }

}  // namespace

Ticks Retiming::bow() const {
    return {static_cast<std::int64_t>(std::ceil(std::abs(bend) / 4 * static_cast<double>((end - start).value)))};
}

template <std::size_t Capacity>
bool retime(StaticVector<Piece, Capacity>& pieces, const Retiming& when) {
    StaticVector<Piece, Capacity> result;
    const Pace pace(total_ticks(pieces), when);
    Motion motion(pieces);
    Ticks gone;  // of the pieces as they are
    Tick device = when.start;
    Displacement reached;
    bool fits = true;
    for (std::size_t i = 0; i < pieces.size(); ++i) {
        const Piece& piece = pieces[i];
        const auto begun = static_cast<double>(gone.value);
        gone += piece.ticks;
        const auto ends = static_cast<double>(gone.value);
        const Ticks needed{static_cast<std::int64_t>(pieces.size() - i) - 1};  // a tick for each that follows
        const bool last = needed == Ticks{};
        const Tick nearest = last ? when.end : when.start + Ticks{std::llround(pace.device_at(ends))};
        const Tick end = std::max(device + Ticks{1}, std::min(nearest, when.end - needed));
        const Displacement place = motion.at(last ? ends : pace.machine_at(end - when.start, ends));
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

template bool retime(StaticVector<Piece, kMaxBodyPieces + 1>&, const Retiming&);
template bool retime(StaticVector<Piece, kMaxTailPieces + 1>&, const Retiming&);

}  // namespace lockstep
