// A separate type for each quantity of motion, so that mixing them does not compile.
//
// Time on an axis is counted in ticks of the step clock (1 us unless configured). Instants (Tick) and durations
// (Ticks) are different types. Space is counted in steps and fractions of 2^-64 step; places (Position) and
// differences (Displacement) are different types too. There is no floating point here: everything is exact.
#pragma once

#include <compare>
#include <cstdint>

namespace lockstep {

__extension__ using Int128 = __int128;
__extension__ using UInt128 = unsigned __int128;

/// A duration on the step clock.
struct Ticks {
    std::int64_t value = 0;
    constexpr auto operator<=>(const Ticks&) const = default;
    constexpr Ticks operator+(Ticks other) const { return {value + other.value}; }
    constexpr Ticks operator-(Ticks other) const { return {value - other.value}; }
    constexpr Ticks operator*(std::int64_t factor) const { return {value * factor}; }
    constexpr Ticks& operator+=(Ticks other) {
        value += other.value;
        return *this;
    }
};

/// An instant on the step clock: ticks since the clock's origin.
struct Tick {
    std::int64_t value = 0;
    constexpr auto operator<=>(const Tick&) const = default;
    constexpr Tick operator+(Ticks d) const { return {value + d.value}; }
    constexpr Tick operator-(Ticks d) const { return {value - d.value}; }
    constexpr Ticks operator-(Tick other) const { return {value - other.value}; }
    constexpr Tick& operator+=(Ticks d) {
        value += d.value;
        return *this;
    }
};

/// The absolute length of a span.
constexpr Ticks length_of(Ticks span) { return {span.value < 0 ? -span.value : span.value}; }

/// Fractions of a step in one step.
inline constexpr Int128 kOneStep = Int128{1} << 64;
inline constexpr Int128 kHalfStep = Int128{1} << 63;

/// A difference of positions, in units of 2^-64 step.
struct Displacement {
    Int128 raw = 0;
    constexpr auto operator<=>(const Displacement&) const = default;
    static constexpr Displacement steps(std::int64_t n) { return {Int128{n} * kOneStep}; }
    constexpr Displacement operator+(Displacement o) const { return {raw + o.raw}; }
    constexpr Displacement operator-(Displacement o) const { return {raw - o.raw}; }
    constexpr Displacement operator-() const { return {-raw}; }
    /// For pictures and figures only: rounds to 53 bits.
    constexpr double as_steps() const { return static_cast<double>(raw) * 0x1p-64; }
};

/// A position of one axis, in units of 2^-64 step. Its count, the number of pulses, is the nearest whole step, halves
/// rounded up. So a step occurs where the position crosses a half.
struct Position {
    Int128 raw = 0;
    constexpr auto operator<=>(const Position&) const = default;
    static constexpr Position steps(std::int64_t n) { return {Int128{n} * kOneStep}; }
    /// From the form used on the wire and in registers: the count, and the low 64 bits of position + 1/2 step.
    static constexpr Position from_count(std::int64_t count, std::uint64_t phase) {
        return {Int128{count} * kOneStep + Int128{phase} - kHalfStep};
    }
    constexpr std::int64_t count() const { return static_cast<std::int64_t>((raw + kHalfStep) >> 64); }
    constexpr std::uint64_t phase() const { return static_cast<std::uint64_t>(raw + kHalfStep); }
    constexpr Position operator+(Displacement d) const { return {raw + d.raw}; }
    constexpr Position operator-(Displacement d) const { return {raw - d.raw}; }
    constexpr Displacement operator-(Position o) const { return {raw - o.raw}; }
    /// For pictures and figures only: rounds to 53 bits.
    constexpr double as_steps() const { return static_cast<double>(raw) * 0x1p-64; }
};

/// The phase of an axis at rest on a whole step, about to move forward.
inline constexpr std::uint64_t kRestPhase = std::uint64_t{1} << 63;

/// Where an axis at rest on `count` starts its next motion. Backward motion starts one unit lower, so that its
/// steps fall on the same ticks as those of the mirrored forward motion, even if the position meets a half exactly.
constexpr Position rest_position(std::int64_t count, bool backward) {
    return {Position::steps(count).raw - (backward ? 1 : 0)};
}

/// Whether an axis at rest here is on a whole step, about to move in either direction.
constexpr bool rests_on_whole_step(Position at) {
    return at == rest_position(at.count(), false) || at == rest_position(at.count(), true);
}

/// Speed in units of 2^-64 step per tick: at most half a step per tick either way.
struct Velocity {
    std::int64_t raw = 0;
    constexpr auto operator<=>(const Velocity&) const = default;
    constexpr double steps_per_tick() const { return static_cast<double>(raw) * 0x1p-64; }
};

/// Acceleration in units of 2^-64 step per tick per tick.
struct Acceleration {
    std::int64_t raw = 0;
    constexpr auto operator<=>(const Acceleration&) const = default;
    constexpr double steps_per_tick2() const { return static_cast<double>(raw) * 0x1p-64; }
};

/// The greatest speed of an axis: one step per two ticks.
inline constexpr double kMaxStepsPerTick = 0.5;
/// The greatest speed of a plan: pieces in whole ticks may be a little faster than the path.
inline constexpr double kMaxPlannedStepsPerTick = kMaxStepsPerTick * 0.98;

}  // namespace lockstep
