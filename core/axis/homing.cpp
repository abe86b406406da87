#include "core/axis/homing.hpp"

namespace lockstep {

std::int64_t Homing::toward_switch(double mm) const {
    const std::int64_t steps = to_steps(axis_, mm);
    return axis_.homing.toward_min ? -steps : steps;
}

HomingStep Homing::begin(bool home_closed) {
    pull_offs_ = 0;
    return search(home_closed ? HomingStage::Release : HomingStage::Search);
}

HomingStep Homing::search(HomingStage stage) {
    stage_ = stage;
    const double travel_mm = axis_.position_max_mm - axis_.position_min_mm;
    const std::int64_t reach = toward_switch(travel_mm * 1.1 + 2 * axis_.homing.pulloff_mm);
    const double speed = axis_.homing.search_velocity_mm_s;
    if (stage == HomingStage::Release) { return {.move = LocalMove{-reach, speed, Trigger::HomeOpens}}; }
    return {.move = LocalMove{reach, speed, Trigger::HomeCloses}};
}

HomingStep Homing::next(const LocalEnd& end) {
    switch (stage_) {
        case HomingStage::Search: return end.by_trigger ? pull_off() : fail(FaultCode::HomeSwitchNotFound);
        case HomingStage::Release: return end.by_trigger ? pull_off() : fail(FaultCode::HomeSwitchStuck);
        case HomingStage::PullOff: {
            if (end.by_limit) { return fail(FaultCode::LimitHit); }
            if (end.home_closed) { return search(HomingStage::Release); }
            stage_ = HomingStage::Latch;
            const double speed = axis_.homing.latch_velocity_mm_s;
            return {.move = LocalMove{toward_switch(2 * axis_.homing.pulloff_mm), speed, Trigger::HomeCloses}};
        }
        case HomingStage::Latch: return end.by_trigger ? zero_and_park(end) : fail(FaultCode::HomeSwitchNotFound);
        case HomingStage::Park:
            stage_ = HomingStage::Idle;
            return end.by_limit ? fail(FaultCode::LimitHit) : HomingStep{.done = true};
        case HomingStage::Idle: break;
    }
    return {};
}

HomingStep Homing::pull_off() {
    if (++pull_offs_ > kMaxPullOffs) { return fail(FaultCode::HomeSwitchStuck); }
    stage_ = HomingStage::PullOff;
    const double speed = axis_.homing.search_velocity_mm_s;
    return {.move = LocalMove{-toward_switch(axis_.homing.pulloff_mm), speed, Trigger::None}};
}

HomingStep Homing::zero_and_park(const LocalEnd& end) {
    stage_ = HomingStage::Park;
    HomingStep step{.zeroed = true, .zero_count = end.trigger_count - to_steps(axis_, axis_.homing.switch_position_mm)};
    const std::int64_t here = end.count - step.zero_count;
    const double speed = axis_.max_velocity_mm_s;
    step.move = LocalMove{to_steps(axis_, axis_.homing.park_mm) - here, speed, Trigger::None};
    return step;
}

HomingStep Homing::fail(FaultCode fault) {
    stage_ = HomingStage::Idle;
    return {.fault = fault};
}

}  // namespace lockstep
