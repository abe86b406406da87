// The inputs and outputs of one loop of an axis, as values.
#pragma once

#include <optional>
#include <span>
#include <vector>

#include "core/axis/device/device.hpp"
#include "core/axis/device/position_claim.hpp"
#include "core/clock/clock_view.hpp"
#include "core/faults.hpp"
#include "core/protocol/messages.hpp"
#include "core/reused_vector.hpp"

namespace lockstep {

struct AxisInputs {
    Tick now;  // machine time
    DeviceStatus device;
    bool has_device = true;            // false: no device answers, and `device` is meaningless
    bool device_failed = false;        // the device refused an order; what it has done since is unknown
    std::span<const InputEdge> edges;  // of the device, in order, each once; all those up to `device`
    std::span<const Frame> frames;
    std::span<const AxisState> peers;
    std::span<const MachineState> coordinator;
    std::span<const AxisCommand> commands;
    std::span<const Command> requests;  // of clients to the coordinator; the axis takes emergency stops from them
    Ticks clock_error;                  // bound on the error of `now`
};

/// A body or tail that the device has run, in machine coordinates. The pulses can be checked against it. The controller
/// returns it in machine time, as commanded. It is recorded in the device's time, as the device was given it, together
/// with the commanded times (core/axis/device_time.hpp).
struct ExecutedTrack {
    Epoch epoch = 0;  // 0: the axis's own move
    FrameNumber frame = 0;
    bool tail = false;
    Tick start;
    Position from;
    std::vector<Piece> pieces;
    bool cut = false;             // pulses ceased early
    std::int64_t stop_count = 0;  // count at its end
    std::int64_t zero_count = 0;
    Tick commanded_start;                // machine time
    std::vector<Ticks> commanded_ticks;  // by piece, machine time; one split at its end counts once. Empty: as given
    Ticks clock_error;                   // each step is made within this plus two ticks of its commanded machine time
};

/// Why a frame was not armed.
struct FailedCheck {
    bool too_late = false;        // the check came too late
    bool held = false;            // this axis holds the frame
    MotorSet lacking;             // those without a fresh state that reports the frame as held
    bool no_coordinator = false;  // there is no evidence from the coordinator
};

/// An event for the log.
struct AxisNotice {
    enum class Kind : std::uint8_t {
        OwnerAdopted,
        EpochBegun,
        EpochEnded,
        FrameRefused,
        Vetoed,
        HomingStage,
        Homed,
        Fault,
        Reset,
        CommandRefused,
        PositionProved,    // the axis is homed by the position that was kept
        PositionUnproved,  // the kept position does not home the axis; `fault` gives the reason
        Touched,           // the input at whose touch the epoch ends
        StepsCorrected     // steps were lost; the axis makes them up by a move of its own
    };
    Kind kind = Kind::Fault;
    FaultCode fault = FaultCode::None;
    std::uint64_t number = 0;          // a term, epoch, frame, stage or tick; steps lost
    std::optional<FailedCheck> check;  // Vetoed: the check that failed
};

struct AxisOutputs {
    std::optional<AxisState> state;  // once a slot
    std::vector<DeviceOrder> orders;
    ReusedVector<ExecutedTrack> tracks;
    std::vector<AxisNotice> notices;
    std::optional<KeptPosition> rests;  // homed, after a run: the position to keep for the next process
    ClockView device_clock;             // for machine time; steps and tracks are recorded in the device's time
    bool device_changed = false;        // from this step on counts are those of another device, or power-up

    /// Prepares the next loop. The lists keep their memory.
    void clear() {
        state.reset();
        orders.clear();
        tracks.clear();
        notices.clear();
        rests.reset();
        device_clock = {};
        device_changed = false;
    }
};

}  // namespace lockstep
