#include "core/axis/device/position_claim.hpp"

#include <cstdlib>

#include "core/kinematics/motors.hpp"

namespace lockstep {

PositionScale scale_of(const MachineConfig& machine, MotorIndex motor) {
    const MotorConfig config = motors_of(machine)[motor];
    return {machine.name,
            config.name,
            config.steps_per_mm,
            config.homing.switch_position_mm,
            config.homing.toward_min,
            config.backlash.steps};
}

FaultCode doubt_of(const KeptPosition& kept, const PositionScale& scale, const DeviceStatus& device,
                   std::int64_t most_pushed) {
    if (kept.scale.machine != scale.machine || kept.scale.axis != scale.axis) { return FaultCode::PositionForeign; }
    if (kept.scale != scale) { return FaultCode::PositionRescaled; }
    if (kept.power_up != device.power_up) { return FaultCode::DevicePoweredUp; }
    const bool rests = device.finished && !device.moving && device.run_asked == device.run;
    if (!rests || kept.run != device.run || kept.position != device.position) { return FaultCode::DeviceHasRun; }
    const std::int64_t pushed = device.encoder_ahead() - kept.encoder_zero;
    return std::abs(pushed) > most_pushed ? FaultCode::PositionPushed : FaultCode::None;
}

}  // namespace lockstep
