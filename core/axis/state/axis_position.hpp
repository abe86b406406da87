// The axis's position: the zero of its machine coordinates, whether the zero is known, and what is kept for the next
// process.
#pragma once

#include <cstddef>
#include <cstdint>
#include <cstdlib>
#include <optional>

#include "core/axis/device/device_view.hpp"
#include "core/axis/device/position_claim.hpp"
#include "core/axis/state/axis_io.hpp"
#include "core/axis/state/followed_play.hpp"
#include "core/machine.hpp"

namespace lockstep {

class AxisPosition {
public:
    /// `kept`: the position that the previous process kept. A board always rests at 0, so its place is always known.
    AxisPosition(const MachineConfig& machine, MotorIndex motor, KeptOrNot kept);

    bool is_board() const { return is_board_; }
    bool homed() const { return homed_; }
    /// The axis is not homed, but follows frames as if it were.
    bool is_assumed() const { return is_assumed_; }
    /// Why the kept position did not home the axis; None once it was homed.
    FaultCode unproved() const { return unproved_; }
    /// Machine coordinates are the device's counts minus this.
    std::int64_t zero_count() const { return zero_count_; }

    /// Call it for each device found, before the first order to it. Returns None if the kept position has homed the
    /// axis, otherwise why not.
    FaultCode claim(const DeviceStatus& device, bool device_failed);
    void begin_homing();
    void assume_zero(std::int64_t zero_count, const DeviceStatus& device);
    /// The motor pushes its slide in the direction of its homing. Steps lost since a place was assumed stay lost.
    void set_zero(std::int64_t zero_count, const DeviceStatus& device);
    /// The device has run these tracks: the play follows them.
    void follow(const ReusedVector<ExecutedTrack>& tracks) {
        for (const ExecutedTrack& track : tracks) { play_.follow(track); }
    }
    /// The motor's place minus its slide's, where the device is now.
    std::int64_t play_steps(const DeviceStatus& device) const { return homed_ ? play_.at(device.position.count()) : 0; }
    void lose() { homed_ = is_board_ && homed_, is_assumed_ = false; }
    void lose_device();

    Position in_machine(Position device) const { return device - Displacement::steps(zero_count_); }
    Position in_device(Position machine) const { return machine + Displacement::steps(zero_count_); }
    /// Encoder minus count since the homing or the assumption, in steps. A board has no encoder.
    std::int64_t following_error(const DeviceStatus& device) const {
        return is_board_ ? 0 : device.encoder_ahead() - encoder_zero_;
    }
    /// So many steps differ that they count as lost.
    bool has_lost_steps(const DeviceStatus& device) const {
        return (homed_ || is_assumed_) && std::abs(following_error(device)) > most_following_error_;
    }

    /// The motor rests where its encoder shows it: lost steps move its place, and no longer count as lost.
    void take_over_encoder(const DeviceStatus& device);
    /// The steps lost since the homing whose loss was taken over, without their signs.
    std::uint32_t corrected_steps() const { return corrected_; }

    /// Call it at rest without a fault. Returns the position to keep, once after each run that leaves the axis homed,
    /// and once after each new zero.
    std::optional<KeptPosition> keep(const DeviceView& device);

private:
    PositionScale scale_;
    KeptOrNot kept_;  // the newest kept position, used when a device is found
    bool is_board_ = false;
    std::int64_t most_following_error_ = 0;
    bool homed_ = false;
    bool is_assumed_ = false;
    FaultCode unproved_ = FaultCode::DeviceMissing;
    std::int64_t zero_count_ = 0;
    std::int64_t encoder_zero_ = 0;          // encoder minus count, at the homing or the assumption
    std::uint32_t corrected_ = 0;            // steps
    std::optional<std::uint64_t> kept_run_;  // the run after which this zero was kept
    FollowedPlay play_;
};

}  // namespace lockstep
