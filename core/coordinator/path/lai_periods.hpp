// The pulses of all axes in each period of a straight move by Lai's method, from rest to rest (lai_path.hpp).
//
// While the long axis keeps its speed, periods can be passed at once. So a move costs as many periods as its axes need
// to gain and to lose their speed, whatever its length.
#pragma once

#include <cstdint>
#include <optional>
#include <span>
#include <vector>

#include "core/machine.hpp"
#include "core/methods/lai_planner.hpp"
#include "core/motion/path.hpp"

namespace lockstep {

inline constexpr std::int64_t kLaiPeriod_ns = 6'500'000;

/// How short axes follow the long one.
enum class LaiFollowing {
    OnTheLine,    // rounded from the start of the move; the deceleration includes the pulses left over
    AsPublished,  // rounded in each period, with both compensations; pulses left over come after the deceleration
};

/// By how many pulses per period the plan changes an axis's speed from one period to the next. It is half of what the
/// limits allow, because rounding may add one, and tails brake with the other half.
std::int64_t lai_change_of(const AxisLimits& axis, Ticks period);

class LaiPeriods {
public:
    /// `limits` must outlive it.
    LaiPeriods(std::span<const AxisLimits> limits, std::int64_t tick_ns, LaiFollowing following);

    /// Begins a move that make_move() has made, and that has a lead axis.
    void begin(const PathMove& move);
    /// Makes the next period. Returns false behind the last one.
    bool next();
    /// How many periods from here on have the same pulses of the long axis as the present one. 0 AsPublished.
    std::int64_t steady() const { return lead_->steady(); }
    /// Makes as many periods at once, at most steady(). In each, an axis makes the mean of its pulses, rounded up or
    /// down.
    void pass(std::int64_t periods);
    /// The pulses of each axis in the present period, signed; behind pass(), in all of these periods.
    std::span<const std::int64_t> pulses() const { return pulses_; }

    Ticks period() const { return period_; }

private:
    methods::LaiSpeeds speeds_of(const PathMove& move) const;
    void begin_followers(const PathMove& move, const methods::LaiSpeeds& speeds);
    template <typename OfFollower>
    void make(std::int64_t pulses, OfFollower of_follower);

    std::span<const AxisLimits> limits_;
    Ticks period_;
    bool is_published_;
    std::optional<methods::LaiLongAxis> lead_;
    std::vector<std::optional<methods::LaiShortAxis>> followers_;  // of each axis except the long one
    std::vector<std::int64_t> signs_;
    std::vector<std::int64_t> pulses_;
};

}  // namespace lockstep
