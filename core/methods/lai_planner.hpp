// The velocity planner: the number of pulses of each axis in each sampling period.
//
// Source: Chiu-Keng Lai, Wei-Nan Chien, Yaw-Ting Tsao, "An FPGA-Based Multiple-Axis Velocity Controller and Stepping
// Motors Drives Design", Sections 3.1 and 3.3. Speed v is a whole number of pulses per period.
//   long axis    v rises by `change` each period (5) to V_max (6), and falls by it (7) once at most
//                v + (v - change) + ... (11) remains. In a short move V_max = floor(sqrt(V_0^2 + change L)), which is
//                (10) for V_0 = 0.
//   short axis   follows with slope m = L_short/L_long (13).
//   compensated  its change per period is limited to `change` (14, 15), and its speed to floor(sqrt(remaining)) (17).
//
// The paper leaves the following open; chosen here:
// - With a change above 1, V_max of (10) may leave too short a distance to fall. The axis gains speed only if the
//   distance that then remains is long enough. With a change of 1 it always is.
// - Pulses that remain after falling are made at the lowest speed, max(V_0, 1). For 107 pulses: 1, 2 ... 10 ... 2, 1
//   and seven single pulses.
// - The rounding of m v to whole pulses. If each period is rounded separately, halves up, (107, -93) ends at -94 as in
//   Fig. 8. If m v is rounded from the start of the move, the short axis is at the right place at every sample and
//   nothing remains, but adjacent periods may differ by two pulses: the sudden change of Fig. 6. Both are available.
// - After the long axis has arrived, a compensated short axis makes its remaining pulses, at V_max at most.
#pragma once

#include <algorithm>
#include <cstdint>
#include <vector>

namespace lockstep::methods {

/// Pulses per period, and pulses per period^2.
struct LaiSpeeds {
    std::int64_t start = 0;   // V_0
    std::int64_t max = 4;     // V_max: reached from rest in four periods, Section 3.1
    std::int64_t change = 1;  // a
};

/// When the pulses that falling leaves over are made. Behind: at the lowest speed after it, as in the paper.
/// WithinTheFall: by holding a speed for one more period while falling.
enum class LaiLeftOver { Behind, WithinTheFall };

/// The long axis's pulses, period after period.
class LaiLongAxis {
public:
    LaiLongAxis(std::int64_t length, const LaiSpeeds& speeds, LaiLeftOver left_over = LaiLeftOver::Behind);

    /// The pulses of the next period; 0 after the whole length.
    std::int64_t next();
    std::int64_t remaining() const { return remaining_; }
    /// How many of the next periods have as many pulses as the last one, because it has its greatest speed and need not
    /// fall yet. Always 0 if pulses are left over Behind.
    std::int64_t steady() const;
    /// Makes as many periods at once, at most steady(). Returns all their pulses.
    std::int64_t pass(std::int64_t periods);

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

/// A speed within this relative distance of a whole number of pulses per period counts as that number.
inline constexpr double kPulseHair = 1e-9;
/// Rounds pulses per period down to a whole number.
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
    /// `speeds`: only V_max and change are used, those of this axis.
    LaiShortAxis(std::int64_t length, std::int64_t long_length, const LaiSpeeds& speeds, LaiRounding rounding,
                 LaiCompensation compensation);

    /// The pulses of a period in which the long axis makes `pulses`.
    std::int64_t follow(std::int64_t pulses);
    /// The pulses of a period after the long axis has arrived.
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

/// Pulses of both axes in each period. The longer axis leads, x if they are equal. One length at least is not 0.
std::vector<PeriodPulses> plan_two_axes(PeriodPulses lengths, const LaiSpeeds& speeds, LaiRounding rounding,
                                        LaiCompensation compensation);

/// The sum over all periods: where the axes end.
PeriodPulses total(const std::vector<PeriodPulses>& periods);

}  // namespace lockstep::methods
