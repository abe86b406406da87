// Converts between the controller, which uses machine time, and the device, which counts ticks of its own clock.
//
// If all clocks are the same, everything passes unchanged. Otherwise their rates and offsets may change at any time. So
// each frame's end is mapped when the frame is loaded, and its start is where the frame before ended. A change of the
// estimates between two loads is corrected within the axis's limits (core/axis/device/frame_pace.hpp). The part not
// corrected yet counts as error.
//
// An axis's own moves are not coordinated. They keep the device's ticks, so that each step is made at exactly the tick
// of its method. Only their start is mapped. Steps and tracks are recorded in the device's time, together with their
// machine time.
#pragma once

#include <deque>
#include <optional>

#include "core/axis/axis_controller.hpp"
#include "core/axis/device/device.hpp"
#include "core/axis/device/frame_pace.hpp"
#include "core/axis/device_clocks.hpp"

namespace lockstep {

class DeviceTime {
public:
    DeviceTime(MotorIndex motor, const MachineConfig& machine);

    const DeviceClocks& clocks() const { return clocks_; }
    DeviceClocks& clocks() { return clocks_; }

    /// Bound on the error of machine time at the last look, and of the bodies that the device holds and has not
    /// finished. Tails do not count. A tail is run only if a next body is missing, and may be long. The error of its
    /// end is recorded with its track, and is no reason to stop.
    Ticks error() const;

    DeviceStatus in_machine_time(DeviceStatus status) const;
    /// Call it for all orders in the order in which the device gets them. A frame that does not fit the device's
    /// segments stays unchanged, and the device refuses it.
    DeviceOrder in_device_time(DeviceOrder order);
    /// Returns the track as the device was given it. Call it for tracks of the run in progress, before the next run
    /// begins, in the order in which they were run. Frames before the track's frame are forgotten.
    ExecutedTrack in_device_time(ExecutedTrack track);

private:
    struct Paced {
        Ticks machine;
        Retiming when;
    };
    struct Loaded {
        device::LoadFrame frame;  // as the device was given it
        Paced body;
        Paced tail;
        Tick body_end;
        Tick end;
        Ticks error;  // the error of the frame's whole body
        Ticks tail_error;
    };

    void load(device::LoadFrame& frame);
    void load(device::LoadOutputs& outputs) const;
    void pace(device::LoadFrame& frame, Tick machine_end, Loaded& loaded);
    template <typename Pieces>
    FramePace::Part part_of(const Pieces& pieces, Tick machine_end) const;

    DeviceClocks clocks_;
    bool own_run_ = false;
    std::optional<Tick> machine_end_;  // end of the frame loaded last in this run
    FramePace pace_;
    Ticks end_error_;            // error of that end
    std::deque<Loaded> loaded_;  // frames loaded and not yet recorded
};

}  // namespace lockstep
