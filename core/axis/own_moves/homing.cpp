#include "core/axis/own_moves/homing.hpp"

#include <algorithm>
#include <cstdlib>

namespace lockstep {

std::int64_t Homing::toward_switch(double mm) const {
    const std::int64_t steps = to_steps(motor_, mm);
    return motor_.homing.toward_min ? -steps : steps;
}

HomingStep Homing::begin(bool home_closed, std::int64_t count) {
    if (!row_of(motor_.homing.way).searches) {
        return {.zeroed = true, .zero_count = count - to_steps(motor_, motor_.homing.park_mm), .done = true};
    }
    approaches_ = false;
    pull_offs_ = 0;
    touches_ = 0;
    last_.reset();
    return search(home_closed ? HomingStage::Release : HomingStage::Search);
}

HomingStep Homing::approach(bool home_closed) {
    if (home_closed) { return {.done = true}; }
    approaches_ = true;
    return search(HomingStage::Search);
}

HomingStep Homing::search(HomingStage stage) {
    stage_ = stage;
    const double travel_mm = motor_.position_max_mm - motor_.position_min_mm;
    const double beyond_mm = std::max(travel_mm + motor_.homing.pulloff_mm, 2 * motor_.plant.travel_margin_mm);
    const std::int64_t reach = toward_switch(travel_mm + motor_.homing.pulloff_mm + beyond_mm);
    const double speed = motor_.homing.search_velocity_mm_s;
    if (stage == HomingStage::Release) { return {.move = LocalMove{-reach, speed, Trigger::HomeOpens}}; }
    return {.move = LocalMove{reach, speed, Trigger::HomeCloses}};
}

HomingStep Homing::next(const LocalEnd& end) {
    switch (stage_) {
        case HomingStage::Search:
            if (!end.by_trigger) { return fail(FaultCode::HomeSwitchNotFound); }
            if (!approaches_) { return touch(end); }
            stage_ = HomingStage::Idle;
            return {.done = true};
        case HomingStage::Release: return end.by_trigger ? pull_off() : fail(FaultCode::HomeSwitchStuck);
        case HomingStage::PullOff: {
            if (end.by_limit) { return fail(FaultCode::LimitHit); }
            if (end.home_closed) { return search(HomingStage::Release); }
            stage_ = HomingStage::Latch;
            const double speed = motor_.homing.latch_velocity_mm_s;
            const std::int64_t way = toward_switch(2 * motor_.homing.pulloff_mm);
            const std::int64_t play = way > 0 ? motor_.backlash.steps : -motor_.backlash.steps;
            return {.move = LocalMove{way + play, speed, Trigger::HomeCloses}};
        }
        case HomingStage::Latch: return end.by_trigger ? touch(end) : miss(end);
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
    const double speed = motor_.homing.search_velocity_mm_s;
    return {.move = LocalMove{-toward_switch(motor_.homing.pulloff_mm), speed, Trigger::None}};
}

/// If the switch sticks or bounces, or the slide is pushed, this touch is elsewhere than the one before. If the slide
/// is pushed after the touch, the switch does not show it, but the encoder differs.
HomingStep Homing::touch(const LocalEnd& end) {
    const std::int64_t tolerance = std::max<std::int64_t>(1, to_steps(motor_, motor_.homing.touch_tolerance_mm));
    const Touch here{end.trigger_count, end.trigger_error, end.encoder_ahead};
    const bool agrees = last_ && std::abs(here.count - last_->count) <= tolerance + here.error + last_->error &&
                        std::abs(here.encoder_ahead - last_->encoder_ahead) <= tolerance;
    if (agrees && stage_ == HomingStage::Latch) { return zero_and_park(end); }
    last_ = here;
    return ++touches_ < kMaxTouches ? pull_off() : fail(FaultCode::HomeSwitchUnsteady);
}

/// The switch is not near the last touch, so that was not a real touch.
HomingStep Homing::miss(const LocalEnd& end) {
    if (end.by_limit) { return fail(FaultCode::HomeSwitchNotFound); }
    last_.reset();
    return ++touches_ < kMaxTouches ? search(HomingStage::Search) : fail(FaultCode::HomeSwitchUnsteady);
}

/// A motor that moves several axes may be faster than these. It parks as slowly as it searches. At the switch it pushes
/// its slide in the direction of its homing; away from there it takes up its play first.
HomingStep Homing::zero_and_park(const LocalEnd& end) {
    stage_ = HomingStage::Park;
    HomingStep step{.zeroed = true,
                    .zero_count = end.trigger_count - to_steps(motor_, motor_.homing.switch_position_mm)};
    const std::int64_t here = end.count - step.zero_count;
    const double speed = motor_.moves_one_axis ? motor_.max_velocity_mm_s : motor_.homing.search_velocity_mm_s;
    const std::int64_t way = to_steps(motor_, motor_.homing.park_mm) - here;
    step.move = LocalMove{way + motor_.backlash.behind(static_cast<double>(way), 0), speed, Trigger::None};
    return step;
}

HomingStep Homing::fail(FaultCode fault) {
    stage_ = HomingStage::Idle;
    return {.fault = fault};
}

}  // namespace lockstep
