// The state machine with a delay counter: Initialize, Standby, Accelerate, Cruise, Decelerate, Stop.
//
// Source: Lam Chee Yuen and Phaklen Ehkan, "Design and Implementation of FPGA Based Bipolar Stepper Motor Controller
// for Linear Slide Application", Section III and Fig. 3. A pulse occurs each time the delay counter runs out; then
//   delay_t = delay_(t-1) - 2 while accelerating (1), delay_t = delay_(t-1) + 10 while decelerating (2).
//
// The paper leaves the following open; chosen here:
// - Decelerate begins when 5 pulses or fewer remain. From the cruising delay 6 the last five waits are 16, 26, 36, 46
//   and 46: the counter grows until it is 44 or more and then stays, and pulses end when the distance is 0. Both of the
//   paper's conditions for the end are met, and every destination is reached exactly.
// - A limit switch counts only if the head moves towards it. Otherwise a move away from the left one would end at once.
// - Initialize drives left at the starting delay; the predefined place is 50 pulses from the origin; the delay before
//   Initialize begins again is a second.
#pragma once

#include <cstdint>

namespace lockstep::methods {

/// Counts of the 10 kHz clock, and pulses.
struct LamParameters {
    double clock_hz = 10'000;
    std::int64_t start_delay = 100;  // 100 Hz
    std::int64_t cruise_delay = 6;   // 1666.67 Hz
    std::int64_t acceleration = 2;   // Eq. (1)
    std::int64_t deceleration = 10;  // Eq. (2)
    std::int64_t stop_delay = 44;
    std::int64_t brake_pulses = 5;
    std::int64_t home_pulses = 50;
    std::int64_t recovery_delay = 10'000;
};

enum class LamState { Initialize, Standby, Accelerate, Cruise, Decelerate, Stop };

struct LamInputs {
    bool left_limit = false;
    bool right_limit = false;
    bool data_ready = false;  // latches the destination, in Standby
    std::int64_t destination = 0;
};

struct LamOutputs {
    bool pulse = false;
    bool right = false;  // the direction; false: left
};

class LamController {
public:
    /// The state at power-up: Initialize.
    explicit LamController(const LamParameters& parameters = {});
    /// In Standby at `location`, as after initialisation.
    static LamController standing_at(std::int64_t location, const LamParameters& parameters = {});

    /// Executes one period of the clock.
    LamOutputs clock(const LamInputs& inputs);

    LamState state() const { return state_; }
    std::int64_t location() const { return location_; }  // pulses from the origin
    std::int64_t delay() const { return delay_; }        // the present wait, in counts

private:
    LamOutputs initialize(const LamInputs& inputs);
    void stand_by(const LamInputs& inputs);
    LamOutputs move(const LamInputs& inputs);
    LamOutputs count_down();
    void begin_move(std::int64_t destination);
    void choose_delay();
    std::int64_t distance() const {
        return destination_ > location_ ? destination_ - location_ : location_ - destination_;
    }

    LamParameters parameters_;
    LamState state_ = LamState::Initialize;
    std::int64_t location_ = 0;
    std::int64_t destination_ = 0;
    std::int64_t delay_;
    std::int64_t left_of_delay_;
    std::int64_t recovery_ = 0;  // counts until Initialize begins again after a limit; 0: no limit
    bool right_ = false;
};

}  // namespace lockstep::methods
