// The hardware DDA: spreads the pulses of a sampling period evenly over it.
//
// Source: Lai, Chien, Tsao, "An FPGA-Based Multiple-Axis Velocity Controller and Stepping Motors Drives Design", Fig.
// 3: an adder and two registers of 8 bits. Each of 256 clocks in a period adds the period's pulses; a carry is a pulse.
// After a whole period the sum has its initial value, so exactly these pulses were made.
#pragma once

#include <cstdint>
#include <vector>

#include "core/methods/lai_planner.hpp"

namespace lockstep::methods {

inline constexpr int kDdaClocks = 256;  // in a period
inline constexpr std::int64_t kMaxPeriodPulses = kDdaClocks - 1;

class Dda {
public:
    /// Loads the pulses of the next period: 0 ... kMaxPeriodPulses.
    void load(std::int64_t pulses) { pulses_ = static_cast<std::uint8_t>(pulses); }
    /// Executes one clock. Returns true if it makes a pulse.
    bool clock() {
        const std::uint8_t before = sum_;
        sum_ = static_cast<std::uint8_t>(sum_ + pulses_);
        return sum_ < before;
    }

private:
    std::uint8_t pulses_ = 0;
    std::uint8_t sum_ = 0;
};

/// How a period's pulses are made. Spread: by the DDAs of both axes in parallel. AtOnce: without DDAs, by the processor
/// at the beginning of the period, first x's and then y's, one each DDA clock. The paper does not say how its lines
/// without a DDA were made. With AtOnce, every line that is not along an axis is less straight, as in Fig. 14.
enum class LaiPulses { Spread, AtOnce };

/// A place of two axes, and the clock at which they reached it.
struct LaiPoint {
    std::int64_t clock = 0;  // of the DDA, kDdaClocks to a period
    std::int64_t x = 0;
    std::int64_t y = 0;
};

/// All places that the axes pass, from (0, 0) on.
std::vector<LaiPoint> walk_two_axes(const std::vector<PeriodPulses>& periods, LaiPulses how);

/// The greatest distance of the points from the straight line between (0, 0) and `end`, in pulses, at a right angle.
double farthest_from_line(const std::vector<LaiPoint>& points, PeriodPulses end);

}  // namespace lockstep::methods
