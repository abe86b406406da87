// What hangs on the simulated device's pulses: a motor that can lose steps, a slide, its switches and an encoder.
//
// The slide moves one step a pulse; its switches and encoder follow where it truly is, so they change at steps only.
//
// The motor is judged by the times of the pulses alone. An interval of n ticks stands for a speed between 1/(n+1) and
// 1/(n-1), as both its ends are rounded to ticks. The rotor's speed follows that band with at most
// max_torque_accel_mm_s2 = A. Where the band still lies further than max_jump_mm_s + sqrt(A) from the rotor's speed,
// the rotor does not catch the pulse: one step is lost. sqrt(A), in steps and ticks, is the speed gained in the first
// half step from rest, which pulses cannot tell from a jump. So a jump of up to max_jump, an acceleration of up to A,
// and both together lose nothing; a greater jump loses at once; a greater acceleration a loses once the rotor has
// fallen back by that much, at the speed (max_jump + sqrt(A)) * a / (a - A). A dead stop loses nothing.
#pragma once

#include <algorithm>
#include <cstdint>

#include "core/machine.hpp"
#include "core/step/segment.hpp"

namespace lockstep {

struct PlantInputs {
    bool limit_min = false;
    bool limit_max = false;
    bool home = false;
    constexpr bool operator==(const PlantInputs&) const = default;
};

class Plant {
public:
    /// The slide stands at plant.start_position_mm. plant.max_jump_mm_s and max_torque_accel_mm_s2 are what the motor
    /// can do: at 0 it loses every step.
    Plant(const AxisConfig& axis, std::int64_t tick_ns);

    /// One pulse. Ticks rise from call to call.
    void step(StepEdge edge) {
        slide_ += edge.direction * static_cast<int>(rotor_follows(edge));
        last_ = edge;
    }
    /// A hand on the slide: moves it without pulses.
    void push(std::int64_t steps) { slide_ += steps; }

    /// Where the slide truly is, in whole steps since power-up.
    std::int64_t encoder() const { return slide_; }
    double position_mm() const;
    PlantInputs inputs() const {
        return {.limit_min = slide_ <= limit_min_at_,
                .limit_max = slide_ >= limit_max_at_,
                .home = home_toward_min_ ? slide_ <= home_at_ : slide_ >= home_at_};
    }

private:
    bool rotor_follows(StepEdge edge);

    double steps_per_mm_;
    double start_mm_;
    std::int64_t limit_min_at_;  // closed at and below, in steps since power-up
    std::int64_t limit_max_at_;  // closed at and above
    std::int64_t home_at_;       // closed at and beyond
    bool home_toward_min_;

    double max_acceleration_;  // A, steps per tick^2
    double max_gap_;           // max_jump + sqrt(A), steps per tick
    double speed_ = 0;         // the rotor's, signed, steps per tick
    StepEdge last_{{kLongAgo}, 0};
    std::int64_t slide_ = 0;

    static constexpr std::int64_t kLongAgo = -(std::int64_t{1} << 62);
};

inline bool Plant::rotor_follows(StepEdge edge) {
    const auto ticks = static_cast<double>((edge.tick - last_.tick).value);
    const double per_width = 1.0 / (ticks * ticks - 0.75);  // (n-1)(n+1), kept positive at n = 1
    const bool onward = edge.direction == last_.direction;
    const double slow = onward ? (ticks - 1) * per_width : 0;  // a reversal: any speed up to the fastest
    const double fast = (ticks + 1) * per_width;
    const double lowest = edge.direction > 0 ? slow : -fast;
    const double highest = edge.direction > 0 ? fast : -slow;
    const double wanted = std::clamp(speed_, lowest, highest);
    const double change = max_acceleration_ * ticks;
    speed_ = std::clamp(wanted, speed_ - change, speed_ + change);
    return std::max(lowest - speed_, speed_ - highest) <= max_gap_;
}

}  // namespace lockstep
