// The homing sequence: search the switch, pull off, touch it again slowly, and repeat until two touches in a row agree.
// Then set the zero there and park. A motor that homes in place sets the zero where it stands. An axis that stands
// behind its switch first moves away until the switch opens. The device itself ends a move at the switch and keeps the
// count, so no network is between the switch and the stop.
//
// One of several motors of an axis first approaches its switch and waits there. When all of them have done so, all
// home, from their switches on.
#pragma once

#include <cstdint>
#include <optional>

#include "core/axis/device/device.hpp"
#include "core/faults.hpp"
#include "core/kinematics/motors.hpp"
#include "core/protocol/homing_stage.hpp"

namespace lockstep {

/// One move of an axis on its own, in steps from where it stands.
struct LocalMove {
    std::int64_t steps = 0;  // signed
    double speed_mm_s = 0;
    Trigger trigger = Trigger::None;
    std::optional<Ticks> ticks = {};  // how long it lasts; nullopt: as fast as the axis's limits allow
};

/// How a local move ended.
struct LocalEnd {
    bool by_trigger = false;
    bool by_limit = false;
    bool home_closed = false;  // the switch is closed now
    std::int64_t count = 0;    // the device's count
    std::int64_t trigger_count = 0;
    std::int64_t trigger_error = 0;  // by how much it may be off, because the touch is known by another clock
    std::int64_t encoder_ahead = 0;  // encoder minus count, now
};

/// The next step of homing: a move, or its end, successful or not.
struct HomingStep {
    std::optional<LocalMove> move;
    bool zeroed = false;  // from now on the machine's count is the device's minus zero_count
    std::int64_t zero_count = 0;
    bool done = false;
    FaultCode fault = FaultCode::None;
};

class Homing {
public:
    explicit Homing(const MotorConfig& motor) : motor_(motor) {}

    /// Begins with the search, or moves away from the switch if it is already closed. `count`: the device's. In place,
    /// this is the whole homing.
    HomingStep begin(bool home_closed, std::int64_t count);
    /// Only the search: done at the switch, without a zero.
    HomingStep approach(bool home_closed);
    /// Call it after the end of each move.
    HomingStep next(const LocalEnd& end);
    void abandon() { stage_ = HomingStage::Idle; }

    HomingStage stage() const { return stage_; }

private:
    struct Touch {
        std::int64_t count = 0;          // the device's, at the switch
        std::int64_t error = 0;          // by how much it may be off
        std::int64_t encoder_ahead = 0;  // encoder minus count, at rest behind the switch
    };

    HomingStep search(HomingStage stage);
    HomingStep pull_off();
    HomingStep touch(const LocalEnd& end);
    HomingStep miss(const LocalEnd& end);
    HomingStep zero_and_park(const LocalEnd& end);
    HomingStep fail(FaultCode fault);
    std::int64_t toward_switch(double mm) const;

    static constexpr int kMaxPullOffs = 16;
    static constexpr int kMaxTouches = 4;

    MotorConfig motor_;
    HomingStage stage_ = HomingStage::Idle;
    bool approaches_ = false;
    int pull_offs_ = 0;
    int touches_ = 0;  // attempts to touch the switch, with those that missed it
    std::optional<Touch> last_;
};

}  // namespace lockstep
