#include "core/axis/state/axis_position.hpp"

#include <utility>

#include "core/kinematics/following_error.hpp"
#include "core/kinematics/motors.hpp"

namespace lockstep {

AxisPosition::AxisPosition(const MachineConfig& machine, MotorIndex motor, KeptOrNot kept)
    : scale_(scale_of(machine, motor)), kept_(std::move(kept)), play_(motors_of(machine)[motor].backlash) {
    const MotorConfig config = motors_of(machine)[motor];
    is_board_ = config.is_board();
    most_following_error_ = most_following_error(config);
}

FaultCode AxisPosition::claim(const DeviceStatus& device, bool device_failed) {
    if (is_board_) {
        set_zero(device.position.count(), device);
        return unproved_ = FaultCode::None;
    }
    unproved_ = !kept_          ? kept_.error()
                : device_failed ? FaultCode::DeviceFault
                                : doubt_of(*kept_, scale_, device, most_following_error_);
    if (unproved_ != FaultCode::None) { return unproved_; }
    zero_count_ = kept_->zero_count;
    encoder_zero_ = kept_->encoder_zero;
    kept_run_ = kept_->run;
    play_.begin(kept_->play_steps, device.position.count());
    homed_ = true;
    return FaultCode::None;
}

void AxisPosition::begin_homing() {
    unproved_ = FaultCode::None;
    homed_ = is_assumed_ = false;
}

void AxisPosition::assume_zero(std::int64_t zero_count, const DeviceStatus& device) {
    zero_count_ = zero_count;
    encoder_zero_ = device.encoder_ahead();
    is_assumed_ = true;
}

/// Steps that the motor lost before the homing no longer count.
void AxisPosition::set_zero(std::int64_t zero_count, const DeviceStatus& device) {
    zero_count_ = zero_count;
    if (!is_assumed_) { encoder_zero_ = device.encoder_ahead(); }
    corrected_ = 0;
    kept_run_.reset();
    play_.begin(0, device.position.count());
    homed_ = true;
    is_assumed_ = false;
}

void AxisPosition::take_over_encoder(const DeviceStatus& device) {
    const std::int64_t error = following_error(device);
    zero_count_ -= error;
    encoder_zero_ += error;
    corrected_ += static_cast<std::uint32_t>(std::abs(error));
}

void AxisPosition::lose_device() {
    homed_ = is_assumed_ = false;
    unproved_ = FaultCode::DeviceMissing;
}

std::optional<KeptPosition> AxisPosition::keep(const DeviceView& device) {
    if (is_board_ || !homed_ || !device.has_ended() || kept_run_ == device.newest_run()) { return std::nullopt; }
    kept_run_ = device.newest_run();
    const DeviceStatus& status = device.status();
    kept_ =
        KeptPosition{scale_, status.power_up, *kept_run_, status.position, zero_count_, encoder_zero_, play_.steps()};
    return *kept_;
}

}  // namespace lockstep
