// The outputs of an axis's device while it follows no frames: as the owner's newest state says, and safe after a fault.
#pragma once

#include <optional>
#include <vector>

#include "core/axis/device/device.hpp"
#include "core/machine.hpp"
#include "core/protocol/messages.hpp"

namespace lockstep {

class RestOutputs {
public:
    RestOutputs(MotorIndex motor, const MachineConfig& machine);

    bool none() const { return outputs_.empty(); }
    /// Takes the newest state of the owner.
    void take(const MachineState& owner) { owner_ = Owner{owner.devices, owner.devices_after, owner.phase}; }
    /// The outputs may be different from those that were ordered: the axis follows frames, or has another device.
    void forget() { ordered_.reset(); }

    struct Axis {
        Epoch epoch = 0;      // the newest that it followed
        bool is_safe = true;  // no fault, and its owner is present
        const DeviceStatus& device;
    };
    /// Call it in a loop in which the axis follows no frames. Returns the change that its outputs need.
    std::optional<device::ChangeOutputs> change(const Axis& axis);

private:
    struct Owner {
        ProgramDevices devices;
        std::optional<Epoch> devices_after;
        MachinePhase phase = MachinePhase::Waiting;
    };
    bool is_off(const OutputConfig& output, const Axis& axis) const;

    std::vector<OutputConfig> outputs_;
    std::optional<Owner> owner_;
    std::optional<device::ChangeOutputs> ordered_;
};

}  // namespace lockstep
