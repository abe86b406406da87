#include "core/motion/profile.hpp"

#include <algorithm>
#include <array>
#include <cmath>
#include <optional>

#include "core/motion/wide_math.hpp"

namespace lockstep {
namespace {

constexpr double kRawPerStepPerTick = 0x1p48;  // 2^64 per step, 2^16 subticks per tick

std::int64_t to_raw(double steps_per_tick) { return std::llround(steps_per_tick * kRawPerStepPerTick); }

/// The distance that the acceleration adds to that of the entry speed over the whole phase.
Int128 curvature(const ProfilePhase& phase) {
    return phase.to.raw - phase.from.raw - Int128{phase.entry} * phase.duration.value;
}

/// Rounds up to whole quanta, in subticks. Caps the result so that sums of phases do not overflow. 0 for NaN.
std::int64_t round_up(double ticks, std::int64_t quantum) {
    constexpr double kLongest_ticks = 0x1p45;
    const double subticks = std::min(ticks, kLongest_ticks) * static_cast<double>(kSubticksPerTick);
    const double quanta = std::ceil(subticks / static_cast<double>(quantum) - 1e-9);
    return quanta > 0 ? static_cast<std::int64_t>(quanta) * quantum : 0;
}

/// Whole numbers of subticks for the three phases, and the peak speed that covers the distance in them.
struct Shape {
    Int128 distance = 0;
    std::int64_t entry = 0, exit = 0;
    std::int64_t rise = 0, cruise = 0, fall = 0;

    std::int64_t peak() const {
        const Int128 twice = 2 * distance - Int128{entry} * rise - Int128{exit} * fall;
        return static_cast<std::int64_t>(floor_div(twice, Int128{rise} + 2 * Int128{cruise} + fall));
    }
};

constexpr double kLimitRounding = 1e-9;  // relative: rounding of a limit in doubles

/// Whether the shape is no faster and no steeper than the limits allow.
bool keeps(const Shape& shape, const PathLimits& limits) {
    const auto peak = static_cast<double>(shape.peak());
    const auto is_gentle = [&](std::int64_t end, std::int64_t ramp, double acceleration) {
        const double change = peak - static_cast<double>(end);
        const double per_subtick2 = acceleration / static_cast<double>(kSubticksPerTick) * kRawPerStepPerTick;
        const double most = per_subtick2 * static_cast<double>(ramp) * (1 + kLimitRounding);
        return ramp == 0 ? change <= 0 : change >= 0 && change <= most;
    };
    return peak <= limits.max_velocity * kRawPerStepPerTick * (1 + kLimitRounding) &&
           is_gentle(shape.entry, shape.rise, limits.max_acceleration) &&
           is_gentle(shape.exit, shape.fall, limits.max_deceleration);
}

/// Rounds a continuous optimum, in ticks, to whole quanta. It adds less than one quantum if the ramps can be rounded so
/// that the limits hold, and one more otherwise. (With both ramps rounded up and one more quantum, the peak and the
/// slopes do not exceed those of the optimum.)
std::optional<Shape> rounded_in_all(Shape shape, double rise, double cruise, double fall,
                                    const ProfileRequest& request) {
    const std::int64_t q = request.quantum;
    const std::int64_t shortest = std::max(q, round_up(rise + cruise + fall, q));
    const auto roundings = [q](double ramp) {
        const std::int64_t up = round_up(ramp, q);
        return std::array{up, std::max<std::int64_t>(0, up - q), std::int64_t{0}};
    };
    for (const std::int64_t total : {shortest, shortest + q}) {
        for (const std::int64_t whole_rise : roundings(rise)) {
            for (const std::int64_t whole_fall : roundings(fall)) {
                shape.rise = whole_rise;
                shape.fall = whole_fall;
                shape.cruise = total - whole_rise - whole_fall;
                if (shape.cruise >= 0 && keeps(shape, request.limits)) { return shape; }
            }
        }
    }
    return std::nullopt;
}

/// If rounding up has put the peak below an end's speed, makes that end's ramp a part of the cruise.
void drop_inverted_ramps(Shape& shape) {
    if (shape.rise > 0 && shape.peak() < shape.entry) {
        shape.cruise += shape.rise;
        shape.rise = 0;
    }
    if (shape.fall > 0 && shape.peak() < shape.exit) {
        shape.cruise += shape.fall;
        shape.fall = 0;
    }
    if (shape.rise > 0 && shape.peak() < shape.entry) {
        shape.cruise += shape.rise;
        shape.rise = 0;
    }
}

Profile build(Displacement from, const Shape& shape) {
    const std::int64_t peak = shape.peak();
    const Displacement to{from.raw + shape.distance};
    const Int128 risen_by = (Int128{shape.entry} + peak) * shape.rise / 2;
    const Int128 falls_by = (Int128{peak} + shape.exit) * shape.fall / 2;
    // The distance left over by rounding the peak is shared in proportion to time, so that it distorts no phase.
    const Int128 time = Int128{shape.rise} + 2 * Int128{shape.cruise} + shape.fall;
    const Int128 left = shape.distance - risen_by - falls_by - Int128{peak} * shape.cruise;
    Displacement risen{from.raw + risen_by + left * shape.rise / time};
    Displacement falling{to.raw - falls_by - left * shape.fall / time};
    if (shape.cruise == 0) { risen = falling = shape.fall == 0 ? to : (shape.rise == 0 ? from : risen); }
    if (shape.rise == 0) { risen = from; }
    Profile profile;
    auto add = [&](Displacement a, Displacement b, std::int64_t entry, std::int64_t n) {
        if (n > 0) { profile.phases.append({a, b, entry, {n}}); }
    };
    add(from, risen, shape.entry, shape.rise);
    add(risen, falling, peak, shape.cruise);
    add(falling, to, peak, shape.fall);
    return profile;
}

/// The longest distance that is possible in `ticks` from rest to rest within limits.
double longest_in(double ticks, double acceleration, const PathLimits& limits) {
    const double top = limits.start_velocity + acceleration * ticks / 2;
    if (top <= limits.max_velocity) { return (limits.start_velocity + top) / 2 * ticks; }
    const double ramp = (limits.max_velocity - limits.start_velocity) / acceleration;
    return (limits.start_velocity + limits.max_velocity) * ramp + limits.max_velocity * (ticks - 2 * ramp);
}

/// Plans a move that is entered above max_velocity. It decelerates at the limit to max_velocity, or to its exit speed
/// if that is higher, and continues with the fastest profile.
Profile plan_slowing(const ProfileRequest& request) {
    const double top = std::max(request.limits.max_velocity, request.exit);
    const double d = request.limits.max_deceleration;
    const double slowing = (request.entry * request.entry - top * top) / (2 * d);
    const Displacement slowed{request.from.raw + static_cast<Int128>(slowing * 0x1p64)};
    if (slowed >= request.to) { return plan_brake_through(request.from, request.to, request.entry, request.exit); }
    Profile profile = plan_brake_through(request.from, slowed, request.entry, top);
    ProfileRequest rest = request;
    rest.from = slowed;
    rest.entry = rest.limits.max_velocity = top;
    for (const ProfilePhase& phase : plan_fastest(rest).phases) { profile.phases.append(phase); }
    return profile;
}

}  // namespace

Displacement ProfilePhase::at(Subticks t) const {
    const Int128 bend = curvature(*this);
    const Int128 magnitude = bend < 0 ? -bend : bend;
    const Int128 part = mul_div(mul_div(magnitude, t.value, duration.value), t.value, duration.value);
    return {from.raw + Int128{entry} * t.value + (bend < 0 ? -part : part)};
}

double ProfilePhase::velocity_at(Subticks t) const {
    const double n = static_cast<double>(duration.value);
    const double per_subtick =
        static_cast<double>(entry) + 2 * static_cast<double>(curvature(*this)) * static_cast<double>(t.value) / (n * n);
    return per_subtick / kRawPerStepPerTick;
}

double ProfilePhase::acceleration() const {
    const double n = static_cast<double>(duration.value);
    return 2 * static_cast<double>(curvature(*this)) / (n * n) / kRawPerStepPerTick *
           static_cast<double>(kSubticksPerTick);
}

Subticks Profile::duration() const {
    Subticks sum;
    for (const ProfilePhase& phase : phases) { sum = sum + phase.duration; }
    return sum;
}

Displacement Profile::at(Subticks t) const {
    for (const ProfilePhase& phase : phases) {
        if (t <= phase.duration) { return phase.at(t); }
        t = t - phase.duration;
    }
    return phases.back().to;
}

double Profile::velocity_at(Subticks t) const {
    for (const ProfilePhase& phase : phases) {
        if (t <= phase.duration) { return phase.velocity_at(t); }
        t = t - phase.duration;
    }
    return phases.back().velocity_at(phases.back().duration);
}

double Profile::peak_velocity() const {
    double peak = 0;
    for (const ProfilePhase& phase : phases) {
        peak = std::max({peak, phase.velocity_at({0}), phase.velocity_at(phase.duration)});
    }
    return peak;
}

Profile plan_fastest(const ProfileRequest& request) {
    if (request.entry > request.limits.max_velocity && request.exit < request.entry) { return plan_slowing(request); }
    const double a = request.limits.max_acceleration;
    const double d = request.limits.max_deceleration;
    const double e = request.entry;
    const double x = request.exit;
    const double distance = (request.to - request.from).as_steps();
    const double apex = std::sqrt((2 * a * d * distance + d * e * e + a * x * x) / (a + d));
    const double peak = std::max({std::min(apex, request.limits.max_velocity), e, x});
    const double rise = (peak - e) / a;
    const double fall = (peak - x) / d;
    const double cruise = std::max(0.0, (distance - (e + peak) / 2 * rise - (peak + x) / 2 * fall) / peak);
    Shape shape{.distance = (request.to - request.from).raw, .entry = to_raw(e), .exit = to_raw(x)};
    if (const auto rounded = rounded_in_all(shape, rise, cruise, fall, request)) {
        return build(request.from, *rounded);
    }
    shape.rise = round_up(rise, request.quantum);
    shape.cruise = round_up(cruise, request.quantum);
    shape.fall = round_up(fall, request.quantum);
    if (shape.rise + shape.cruise + shape.fall == 0) { shape.cruise = request.quantum; }
    drop_inverted_ramps(shape);
    return build(request.from, shape);
}

Profile plan_brake_through(Displacement from, Displacement to, double entry, double exit) {
    const double subticks = 2 * (to - from).as_steps() / (entry + exit) * static_cast<double>(kSubticksPerTick);
    Profile profile;
    profile.phases.append({from, to, to_raw(entry), {std::max<std::int64_t>(1, static_cast<std::int64_t>(subticks))}});
    return profile;
}

Profile plan_brake_to(Displacement from, double entry, double deceleration, Subticks start) {
    constexpr Ticks kLeastTicks{2};
    const Subticks steepest = start + Subticks{round_up(entry / deceleration, 1)};
    const Ticks end = std::max(steepest.ceil(), start.ceil() + kLeastTicks);
    const Subticks n = subticks(end) - start;
    const double distance = entry / 2 * static_cast<double>(n.value) / static_cast<double>(kSubticksPerTick);
    Profile profile;
    profile.phases.append({from, {from.raw + static_cast<Int128>(distance * 0x1p64)}, to_raw(entry), n});
    return profile;
}

Profile plan_steady(Displacement from, Displacement to, Ticks ticks) {
    const Subticks n = subticks(ticks);
    Profile profile;
    profile.phases.append({from, to, static_cast<std::int64_t>((to - from).raw / n.value), n});
    return profile;
}

Profile plan_dwell(Displacement at, Ticks ticks) {
    Profile profile;
    profile.phases.append({at, at, 0, subticks(ticks)});
    return profile;
}

std::expected<Profile, Infeasible> plan_in_time(Displacement distance, Ticks ticks, const PathLimits& limits) {
    const double n = distance.as_steps();
    const double t = static_cast<double>(ticks.value);
    const double a = std::min(limits.max_acceleration, limits.max_deceleration);
    const double start = limits.start_velocity;
    const auto infeasible = [&] {
        PathLimits symmetric = limits;
        symmetric.max_acceleration = symmetric.max_deceleration = a;
        const Profile fastest = plan_fastest({{}, distance, start, start, symmetric});
        const double longest = longest_in(t, a, limits);
        return std::unexpected(Infeasible{fastest.duration().ceil(), {static_cast<Int128>(longest * 0x1p64)}});
    };
    if (ticks.value <= 0 || n > limits.max_velocity * t) { return infeasible(); }

    Shape shape{.distance = distance.raw, .entry = to_raw(start), .exit = to_raw(start)};
    const double top = 2 * n / t - start;
    double ramp = 0;  // below the start velocity: constant speed
    if (n / t > start) {
        ramp = top <= limits.max_velocity ? t / 2 : (limits.max_velocity * t - n) / (limits.max_velocity - start);
    }
    const auto ramp_ticks = static_cast<std::int64_t>(std::floor(ramp + 1e-6));
    shape.rise = shape.fall = ramp_ticks * kSubticksPerTick;
    shape.cruise = subticks(ticks).value - 2 * shape.rise;
    const double peak = static_cast<double>(shape.peak()) / kRawPerStepPerTick;
    const bool jumps = ramp_ticks == 0 && peak > start * (1 + 1e-9);
    if (jumps || (ramp_ticks > 0 && (peak - start) / static_cast<double>(ramp_ticks) > a * (1 + 1e-6))) {
        return infeasible();
    }
    return build({}, shape);
}

}  // namespace lockstep
