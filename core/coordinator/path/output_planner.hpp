// The changes of outputs that travel in frames: switched by the events of a program, or in proportion to the speed of
// its path.
//
// An event changes outputs at the tick at which the motion reaches its place, in the body or in the tail of a frame.
// The first frame of an epoch states the levels of all outputs at its first tick, because those that go off at an
// interruption are off. While the speed of the path changes evenly, an output that follows it changes by the same
// amount in each tick.
#pragma once

#include <span>
#include <vector>

#include "core/coordinator/path/event_queue.hpp"
#include "core/machine.hpp"
#include "core/path/path_speed.hpp"
#include "core/program_devices.hpp"
#include "core/protocol/frame_room.hpp"
#include "core/protocol/messages.hpp"

namespace lockstep {

class OutputPlanner {
public:
    explicit OutputPlanner(const MachineConfig& machine);

    /// An epoch begins. `devices`: as the program's words have left them.
    void begin(const ProgramDevices& devices);

    /// The events with places in a frame, in order.
    struct Events {
        std::span<const FrameEvent> body;
        std::span<const FrameEvent> tail;
    };
    /// Sets `outputs` to the changes in the next frame of the epoch, for each motor whose device has outputs.
    void plan(const PathFrame& frame, const Events& events, std::vector<MotorOutputs>& outputs);
    /// Devices wait for places if the machine rests after that frame.
    bool has_pulses() const { return has_pulses_; }

private:
    /// The motion of an analog output.
    struct Ramp {
        double value = 0;  // of full scale, at the begin of the body or tail
        double slope = 0;  // for each tick
        double at(double tick) const { return value + slope * tick; }
    };
    struct Motor {
        std::uint32_t number = 0;
        double steps_per_mm = 0;  // along its axis, signed
        std::vector<OutputConfig> outputs;
        std::vector<Ramp> ramps;  // one for each of `outputs`
    };
    struct Part;
    class AnalogChanges;

    template <typename Changes>
    void plan_part(const Part& part, Motor& motor, std::size_t room, Changes& changes) const;
    void list_digital(const Part& part, const Motor& motor, std::vector<OutputChange>& changes) const;
    void list_pulses(const Part& part, const Motor& motor, const OutputConfig& output,
                     std::vector<OutputChange>& changes) const;

    std::vector<Motor> motors_;
    OutputRoom room_;
    ProgramDevices devices_;  // where the next frame begins
    bool is_first_ = true;
    bool has_pulses_ = false;
};

}  // namespace lockstep
