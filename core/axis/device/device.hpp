// The values that an axis controller exchanges with its device once per loop: the device's status, and orders to it. A
// driver (services/axis) converts them to register reads and writes. sim_fpga/registers.json defines the registers.
#pragma once

#include <cstdint>
#include <variant>

#include "core/hardware/output_change.hpp"
#include "core/protocol/messages.hpp"
#include "core/step/segment.hpp"

namespace lockstep {

/// One consistent look at the device. Counts are the device's own, from its power-up; never reset.
struct DeviceStatus {
    Tick now;  // the device has executed every tick up to and with this one
    Position position;
    Velocity velocity;  // 0 at rest
    bool moving = false;
    std::uint64_t power_up = 0;   // identifies this power-up among all power-ups of all devices
    std::uint64_t run = 0;        // the run (see BeginRun) the device is in or has ended
    std::uint64_t run_asked = 0;  // the run asked for last; if it differs from `run`, it has not been taken yet
    FrameNumber frame = 0;        // the highest frame of the run whose body has begun; 0: none
    bool finished = false;        // the run has ended and the axis is at rest
    bool in_tail = false;         // coming to rest by a tail, or ended in one
    bool limit_min = false;
    bool limit_max = false;
    bool home = false;
    bool stopped_by_limit = false;    // this run ended at a limit switch
    bool stopped_by_trigger = false;  // this run ended by its trigger
    bool stopped_by_host = false;     // this run ended by StopNow
    std::int64_t trigger_count = 0;   // the device's count when the trigger ended a run
    bool bad_segment = false;         // a late or discontinuous segment was refused, and the run ended
    bool capture_overflow = false;    // steps were made, but their times could not be kept
    std::int64_t encoder_count = 0;
    std::uint32_t free_segments = 0;  // room in the segment ring
    std::uint32_t inputs = 0;         // the inputs that are closed; input n is bit n
    std::uint16_t outputs = 0;        // the digital outputs that are on
    std::uint32_t pulses_left = 0;    // of the newest places: so many were not made, so far or when they ended
    AnalogLevels analog{};            // what its analog outputs show
    bool enabled = false;             // the motor is enabled
    bool bad_setup = false;           // the device does not take the setup that it was given
    bool host_silent = false;         // the device received no beat for the time of its setup
    bool stopped_by_input = false;    // this run ended, or did not begin, because a stop input is closed
    bool bad_output = false;  // changes of outputs in this run were malformed, and none of their frame's was made

    /// Encoder minus count, in steps.
    std::int64_t encoder_ahead() const { return encoder_count - position.count(); }
};

/// A change of an input. The input follows its pin later, by its debounce.
struct InputEdge {
    Tick tick;  // when the pin changed
    std::uint8_t channel = 0;
    bool closed = false;  // from then on
    bool operator==(const InputEdge&) const = default;
};

enum class Trigger : std::uint8_t { None, HomeCloses, HomeOpens, InputCloses, InputOpens };

namespace device {

/// A run is a sequence of frames from rest to rest. It forgets what was loaded, armed or vetoed before.
/// `trigger` ends it at the first tick on which the home input, or the named one, has that level.
struct BeginRun {
    std::uint64_t run = 0;
    Trigger trigger = Trigger::None;
    bool own = false;          // a move of the axis's own: its durations are ticks of the device, not of machine time
    std::uint8_t channel = 0;  // of the input that InputCloses and InputOpens name
};
/// Loads one frame's body and tail after those loaded before. Positions are the device's own.
struct LoadFrame {
    FrameNumber number = 0;
    Tick start;
    bool last = false;
    AxisTrack track;
};
/// Loads the changes of outputs of the frame that was loaded last, before it is armed.
struct LoadOutputs {
    FrameNumber number = 0;
    OutputTrack track;
};
/// Changes outputs at once.
struct ChangeOutputs {
    SetDigital digital;
    StaticVector<RampAnalog, kMostAnalogOutputs> analog;  // without slope
    bool operator==(const ChangeOutputs&) const = default;
};
/// Frames up to this one may be run.
struct Arm {
    FrameNumber number = 0;
};
/// This frame and those after it may not be run, if not begun.
struct Veto {
    FrameNumber number = 0;
};
/// Pulses cease at the next tick.
struct StopNow {};

}  // namespace device

using DeviceOrder = std::variant<device::BeginRun, device::LoadFrame, device::Arm, device::Veto, device::StopNow,
                                 device::LoadOutputs, device::ChangeOutputs>;

}  // namespace lockstep
