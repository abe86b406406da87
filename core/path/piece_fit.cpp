#include "core/path/piece_fit.hpp"

#include <algorithm>
#include <cmath>

#include "core/motion/interpolate.hpp"

namespace lockstep {
namespace {

constexpr double kMostTolerance = 64;

double to_double(Ticks t) { return static_cast<double>(t.value); }

/// The nearest position to a place in steps; exact for whole steps.
Position position_of(double steps) {
    const double whole = std::floor(steps);
    return {Int128{static_cast<std::int64_t>(whole)} * kOneStep + static_cast<Int128>((steps - whole) * 0x1p64)};
}

}  // namespace

PieceFit::PieceFit(const PathSetup& setup)
    : setup_(setup),
      fitted_(setup.motors()),
      pieces_(setup.motors()),
      points_(setup.motors()),
      try_pieces_(setup.motors()),
      try_points_(setup.motors()) {
    for (std::vector<Piece>& pieces : fitted_) { pieces.reserve(std::max(setup.body_pieces, setup.tail_pieces)); }
}

/// The tick at which a piece from `now` must end. A jump between two ticks is put into the longer of the two adjacent
/// pieces, because it distorts the velocity of that one less.
Ticks PieceFit::next_break(Ticks now, Ticks end) const {
    const auto& phases = path_->phases();
    for (std::size_t k = phase_; k < phases.size() && phases[k].begin < to_double(end); ++k) {
        if (!phases[k].breaks) { continue; }
        std::size_t next = k + 1;
        while (next < phases.size() && !phases[next].breaks) { ++next; }
        const double limit = next < phases.size() ? std::min(phases[next].begin, to_double(end)) : to_double(end);
        const bool is_nearer = phases[k].begin - to_double(now) < limit - phases[k].begin;
        const Ticks at{static_cast<std::int64_t>(is_nearer ? std::floor(phases[k].begin) : std::ceil(phases[k].begin))};
        if (at > now) { return std::min(at, end); }
    }
    return end;
}

/// The phases that determine the velocities at the ends of a piece from `begin` to `end`. A jump within a tick of an
/// end counts as outside the piece.
PieceFit::FitRange PieceFit::range(Ticks begin, Ticks end) const {
    constexpr double kHair = 0x1p-20;
    const auto& phases = path_->phases();
    FitRange s{begin, end, phase_, phase_};
    const double from = to_double(begin);
    const double to = to_double(end);
    while (s.first + 1 < phases.size() && phases[s.first + 1].begin <= from + kHair) { ++s.first; }
    for (std::size_t k = s.first + 1; k < phases.size() && phases[k].begin < std::min(from + 1, to); ++k) {
        if (phases[k].breaks) { s.first = k; }
    }
    s.last = s.first;
    while (s.last + 1 < phases.size() && phases[s.last + 1].begin < to - kHair) {
        const PathPhase& next = phases[s.last + 1];
        if (next.breaks && next.begin > to - 1) { break; }
        ++s.last;
    }
    return s;
}

double PieceFit::acceleration(const FitRange& s, MotorIndex i) const {
    const double before = path_->phases()[s.first].velocity(i, to_double(s.begin));
    const double after = path_->phases()[s.last].velocity(i, to_double(s.end));
    const AxisLimits& axis = setup_.limits[i];
    const bool speeds_up = std::abs(after) > std::abs(before);
    const double most = speeds_up ? axis.max_acceleration : axis.max_deceleration;
    return std::clamp((after - before) / to_double(s.end - s.begin), -most, most);
}

/// In each phase the path is nearly a parabola, so the ends and the middles of the phases are compared.
bool PieceFit::is_close(const FitRange& s, MotorIndex i, double from, double v0, double a) const {
    const auto& phases = path_->phases();
    const double begin = to_double(s.begin);
    const double ticks = to_double(s.end - s.begin);
    const auto is_near = [&](const PathPhase& phase, double t) {
        const double gone = t - begin;
        return std::abs(phase.place(i, t) - from - (v0 + a * gone / 2) * gone) <= kFitShare;
    };
    for (std::size_t k = s.first; k <= s.last; ++k) {
        const PathPhase& phase = phases[k];
        const double t0 = std::max(phase.begin, begin);
        const double t1 = std::min(phase.end(), begin + ticks);
        if (!is_near(phase, (t0 + t1) / 2) || !is_near(phase, t1)) { return false; }
        if (s.first == s.last && !(is_near(phase, (3 * t0 + t1) / 4) && is_near(phase, (t0 + 3 * t1) / 4))) {
            return false;
        }
    }
    return true;
}

/// The phase that is in progress at the end of a range.
const PathPhase& PieceFit::phase_at(const FitRange& s) const {
    const auto& phases = path_->phases();
    std::size_t k = s.last;
    while (k + 1 < phases.size() && phases[k].end() < to_double(s.end)) { ++k; }
    return phases[k];
}

/// Whether the axis reverses within the piece with more acceleration than the smaller of its limits. A part of such a
/// piece would break a limit, so a tail that contains it could not be cut.
bool PieceFit::is_hard_reversal(MotorIndex i, double v0, double a, double ticks) const {
    const double v1 = v0 + a * ticks;
    const double one_tick = std::abs(a);
    const AxisLimits& axis = setup_.limits[i];
    return v0 * v1 < 0 && std::min(std::abs(v0), std::abs(v1)) > one_tick &&
           std::abs(a) > std::min(axis.max_acceleration, axis.max_deceleration);
}

bool PieceFit::try_piece(Ticks begin, Ticks end, std::span<const MotionPoint> points) {
    const FitRange s = range(begin, end);
    const double ticks = to_double(end - begin);
    const PathPhase& last = path_->phases()[s.last];
    const PathPhase& first = path_->phases()[s.first];
    const PathPhase& at_end = phase_at(s);
    for (const MotorIndex i : motor_indices(setup_.motors())) {
        const double a = acceleration(s, i);
        const Position to = position_of(at_end.place(i, to_double(end)));
        const double v0 = (to - points[i].position).as_steps() / ticks - a * ticks / 2;
        const double most = tolerance_ * kSpeedTolerance * setup_.limits[i].start_velocity;
        const bool is_near = std::abs(v0 - first.velocity(i, to_double(begin))) <= most &&
                             std::abs(v0 + a * ticks - last.velocity(i, to_double(end))) <= most;
        if (!(is_near && is_close(s, i, points[i].position.as_steps(), v0, a))) { return false; }
        if (tolerance_ <= 1 && is_hard_reversal(i, v0, a, ticks)) { return false; }
        try_pieces_[i] = solve_piece(points[i].position, to, end - begin, a);
    }
    for (const MotorIndex i : motor_indices(setup_.motors())) {
        try_points_[i] = points[i];
        if (check_pieces({&try_pieces_[i], 1}, setup_.limits[i], try_points_[i]) != FaultCode::None) { return false; }
    }
    std::swap(pieces_, try_pieces_);
    std::swap(points_, try_points_);
    return true;
}

/// Begins with the last piece's length, or the rest of a straight phase. Halves or doubles it, then bisects to within a
/// quarter. Returns 0 if no piece keeps the limits.
Ticks PieceFit::longest(Ticks now, Ticks limit, std::span<const MotionPoint> points) {
    const Ticks whole = limit - now;
    const auto fits = [&](std::int64_t ticks) { return try_piece(now, now + Ticks{ticks}, points); };
    std::int64_t good = 0;
    std::int64_t bad = whole.value + 1;
    const PathPhase& phase = path_->phases()[phase_];
    const auto left = static_cast<std::int64_t>(std::min(phase.end() - to_double(now), to_double(whole)));
    const bool is_parabola = phase.shape->is_straight && left > kShort_ticks;
    std::int64_t ticks = std::clamp<std::int64_t>(is_parabola ? left : guess_.value, 1, whole.value);
    while (good == 0 && ticks >= 1) {
        (fits(ticks) ? good : bad) = ticks;
        ticks /= 2;
    }
    while (good > 0 && good < whole.value && bad > whole.value) {
        const std::int64_t more = std::min(2 * good, whole.value);
        (fits(more) ? good : bad) = more;
    }
    while (bad - good > std::max<std::int64_t>(good / 4, 1)) {
        const std::int64_t middle = (good + bad) / 2;
        (fits(middle) ? good : bad) = middle;
    }
    return {good};
}

/// Returns the longest piece that fits. If no piece fits, tries again with a wider tolerance of speeds, because the
/// rounding of the ends to ticks changes the speed of a short piece most. The limits of the axes hold with every
/// tolerance.
Ticks PieceFit::longest_any(Ticks now, Ticks limit, std::span<const MotionPoint> points) {
    Ticks ticks;
    for (tolerance_ = 1; ticks == Ticks{} && tolerance_ <= kMostTolerance; tolerance_ *= 4) {
        ticks = longest(now, limit, points);
    }
    tolerance_ = 1;
    return ticks;
}

std::optional<FitFailure> PieceFit::fit(const TimedPath& path, Ticks end, std::size_t most,
                                        std::span<MotionPoint> points) {
    path_ = &path;
    const auto& phases = path.phases();
    for (std::vector<Piece>& pieces : fitted_) { pieces.clear(); }
    phase_ = 0;
    guess_ = Ticks{64};
    std::size_t made = 0;
    for (Ticks now; now < end;) {
        while (phase_ + 1 < phases.size() && phases[phase_ + 1].begin <= to_double(now)) { ++phase_; }
        const Ticks limit = next_break(now, end);
        Ticks ticks = longest_any(now, limit, points);
        const Ticks rest = limit - now - ticks;
        const Ticks half{(limit - now).value / 2};
        if (ticks > Ticks{} && rest > Ticks{} && rest < Ticks{kShort_ticks} && half >= Ticks{kShort_ticks} &&
            try_piece(now, now + half, points)) {
            ticks = half;
        }
        if (ticks == Ticks{}) { return FitFailure{now}; }
        if (made == most) { return FitFailure{now, FitFailure::Why::Full}; }
        for (const MotorIndex i : motor_indices(setup_.motors())) {
            points[i] = points_[i];
            fitted_[i].push_back(pieces_[i]);
        }
        guess_ = ticks;
        ++made;
        now += ticks;
    }
    return std::nullopt;
}

}  // namespace lockstep
