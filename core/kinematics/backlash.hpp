// The play between a motor and its slide, and where the slide is within it.
//
// A motor that reverses first goes through the play, and then moves its slide. `Play` is the motor's place minus its
// slide's: 0 while the motor pushes in the direction of its homing, and the whole play, with a sign, while it pushes
// the other way. Each step of the motor changes it until it is at an end, and then moves the slide. So the play is a
// function of the motor's steps since its homing.
#pragma once

#include <algorithm>
#include <cstdint>

namespace lockstep {

/// The backlash of a motor.
struct Backlash {
    std::int64_t steps = 0;  // 0: none
    double speed_mm_s = 0;   // of the motor's way, while it takes up the play
    bool toward_min = true;  // the direction in which the motor homes

    bool is_none() const { return steps == 0; }
    /// The play while the motor pushes its slide down, and up.
    std::int64_t low() const { return toward_min ? 0 : -steps; }
    std::int64_t high() const { return toward_min ? steps : 0; }
    /// The play after a motion of the slide by `way`; `before` if it does not move.
    std::int64_t behind(double way, std::int64_t before) const { return way > 0 ? high() : way < 0 ? low() : before; }
    bool operator==(const Backlash&) const = default;
};

class Play {
public:
    explicit Play(const Backlash& backlash) : backlash_(backlash) {}

    std::int64_t steps() const { return steps_; }
    void set(std::int64_t steps) { steps_ = std::clamp(steps, backlash_.low(), backlash_.high()); }
    /// The motor has moved in one direction.
    void follow(std::int64_t steps) { set(steps_ + steps); }

private:
    Backlash backlash_;
    std::int64_t steps_ = 0;
};

}  // namespace lockstep
