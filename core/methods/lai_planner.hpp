// The velocity planner: how many pulses each axis makes in each sampling period.
//
// Source: Chiu-Keng Lai, Wei-Nan Chien, Yaw-Ting Tsao, "An FPGA-Based Multiple-Axis Velocity Controller and Stepping
// Motors Drives Design", Sections 3.1 and 3.3. Speed v is a whole number of pulses per period.
//   long axis    v rises by `change` each period (5) to V_max (6), and falls by it (7) once no more remains than
//                v + (v - change) + ... (11). A short move: V_max = floor(sqrt(V_0^2 + change L)), which is (10) for
//                V_0 = 0.
//   short axis   follows with slope m = L_short/L_long (13).
//   compensated  its change per period is limited to `change` (14, 15), and its speed to floor(sqrt(remaining)) (17).
//
// Left open there and chosen here:
// - With a change above 1, V_max of (10) may leave too little to fall from: the axis gains speed only where what then
//   remains is enough. With 1 that is always so.
// - What falling has left over is made at the lowest speed, max(V_0, 1). For 107 pulses: 1, 2 ... 10 ... 2, 1 and seven
//   single pulses.
// - How m v becomes whole pulses. Rounded in each period for itself, halves up, (107, -93) ends at -94 as in Fig. 8.
//   Rounded from the start, so that the short axis is where it belongs at every sample, nothing is left over, but
//   neighbouring periods may differ by two pulses: the sudden change of Fig. 6. Hence both.
// - Once the long axis has arrived, a compensated short axis makes what remains of its own, at V_max at most.
#pragma once

#include <algorithm>
#include <cstdint>
#include <vector>

namespace lockstep::methods {

/// Pulses per period, and per period and period.
struct LaiSpeeds {
    std::int64_t start = 0;   // V_0
    std::int64_t max = 4;     // V_max: four periods to it from rest, Section 3.1
    std::int64_t change = 1;  // a
};

/// Where what falling leaves over is made: at the lowest speed behind it, as in the paper, or by holding a speed once
/// more on the way down.
enum class LaiLeftOver { Behind, WithinTheFall };

/// The long axis's pulses, period after period.
class LaiLongAxis {
public:
    LaiLongAxis(std::int64_t length, const LaiSpeeds& speeds, LaiLeftOver left_over = LaiLeftOver::Behind);

    /// None once the whole length is made.
    std::int64_t next();
    std::int64_t remaining() const { return remaining_; }

private:
    LaiSpeeds speeds_;
    LaiLeftOver left_over_;
    std::int64_t lowest_;
    std::int64_t top_;
    std::int64_t remaining_;
    std::int64_t speed_ = 0;
    bool falling_ = false;
};

/// Pulses of each period; their sum is `length` (> 0).
std::vector<std::int64_t> plan_long_axis(std::int64_t length, const LaiSpeeds& speeds);

/// A speed this close to a whole number of pulses per period, relatively, is one.
inline constexpr double kPulseHair = 1e-9;
/// The whole pulses in a period of so many, downwards.
std::int64_t whole_pulses(double pulses);

enum class LaiRounding { InEachPeriod, FromTheStart };

/// Which of the two compensations of the short axis are on.
struct LaiCompensation {
    bool derivative = true;  // Eqs. (14) and (15)
    bool remaining = true;   // Eqs. (16) and (17)
};
inline constexpr LaiCompensation kUncompensated{false, false};

/// The pulses of an axis that follows the long one with slope length / long_length.
class LaiShortAxis {
public:
    /// Of the speeds, its own V_max and change.
    LaiShortAxis(std::int64_t length, std::int64_t long_length, const LaiSpeeds& speeds, LaiRounding rounding,
                 LaiCompensation compensation);

    /// While the long axis makes its next `pulses`.
    std::int64_t follow(std::int64_t pulses);
    /// Once the long axis has arrived.
    std::int64_t finish() { return make(std::min(speeds_.max, remaining())); }
    std::int64_t remaining() const { return length_ - done_; }

private:
    std::int64_t share(std::int64_t along) const;
    std::int64_t make(std::int64_t v);

    std::int64_t length_;
    std::int64_t long_length_;
    LaiSpeeds speeds_;
    LaiRounding rounding_;
    LaiCompensation compensation_;
    std::int64_t speed_ = 0;
    std::int64_t long_done_ = 0;
    std::int64_t done_ = 0;
};

struct PeriodPulses {
    std::int64_t x = 0;  // signed
    std::int64_t y = 0;
    bool operator==(const PeriodPulses&) const = default;
};

/// Pulses of both axes in each period; the longer one leads, x where they are equal. At least one length is not 0.
std::vector<PeriodPulses> plan_two_axes(PeriodPulses lengths, const LaiSpeeds& speeds, LaiRounding rounding,
                                        LaiCompensation compensation);

/// The sum over all periods: where the axes end.
PeriodPulses total(const std::vector<PeriodPulses>& periods);

}  // namespace lockstep::methods
