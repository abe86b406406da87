#include "core/methods/lam_controller.hpp"

#include <algorithm>

namespace lockstep::methods {

LamController::LamController(const LamParameters& parameters)
    : parameters_(parameters), delay_(parameters.start_delay), left_of_delay_(parameters.start_delay) {}

LamController LamController::standing_at(std::int64_t location, const LamParameters& parameters) {
    LamController controller(parameters);
    controller.state_ = LamState::Standby;
    controller.location_ = controller.destination_ = location;
    return controller;
}

LamOutputs LamController::clock(const LamInputs& inputs) {
    switch (state_) {
        case LamState::Initialize: return initialize(inputs);
        case LamState::Stop:
            location_ = 0;
            begin_move(parameters_.home_pulses);
            return {};
        case LamState::Standby: stand_by(inputs); return {};
        case LamState::Accelerate:
        case LamState::Cruise:
        case LamState::Decelerate: break;
    }
    return move(inputs);
}

LamOutputs LamController::initialize(const LamInputs& inputs) {
    right_ = false;
    if (inputs.left_limit) {
        state_ = LamState::Stop;
        return {};
    }
    return count_down();
}

void LamController::stand_by(const LamInputs& inputs) {
    if (recovery_ > 0) {
        if (--recovery_ > 0) { return; }
        state_ = LamState::Initialize;
        delay_ = left_of_delay_ = parameters_.start_delay;
    } else if (inputs.data_ready && inputs.destination != location_) {
        begin_move(inputs.destination);
    }
}

void LamController::begin_move(std::int64_t destination) {
    destination_ = destination;
    right_ = destination_ > location_;
    delay_ = left_of_delay_ = parameters_.start_delay;
    state_ = distance() <= parameters_.brake_pulses ? LamState::Decelerate : LamState::Accelerate;
}

LamOutputs LamController::move(const LamInputs& inputs) {
    if (right_ ? inputs.right_limit : inputs.left_limit) {
        state_ = LamState::Standby;
        recovery_ = parameters_.recovery_delay;
        return {};
    }
    const LamOutputs outputs = count_down();
    if (outputs.pulse) { choose_delay(); }
    return outputs;
}

LamOutputs LamController::count_down() {
    if (--left_of_delay_ > 0) { return {.right = right_}; }
    left_of_delay_ = delay_;
    location_ += right_ ? 1 : -1;
    return {.pulse = true, .right = right_};
}

/// Sets the wait for the next pulse.
void LamController::choose_delay() {
    if (distance() == 0) {
        state_ = LamState::Standby;
    } else if (distance() <= parameters_.brake_pulses) {
        state_ = LamState::Decelerate;
        if (delay_ < parameters_.stop_delay) { delay_ += parameters_.deceleration; }
    } else if (state_ == LamState::Accelerate) {
        delay_ = std::max(parameters_.cruise_delay, delay_ - parameters_.acceleration);
        if (delay_ == parameters_.cruise_delay) { state_ = LamState::Cruise; }
    }
    left_of_delay_ = delay_;
}

}  // namespace lockstep::methods
