// What one loop of an axis takes, and what it gives back, as values.
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
    bool has_device = true;      // false: none answers, and `device` means nothing
    bool device_failed = false;  // it refused an order: what it then does is not known
    std::span<const Frame> frames;
    std::span<const AxisState> peers;
    std::span<const MachineState> coordinator;
    std::span<const AxisCommand> commands;
    std::span<const Command> requests;  // clients', to the coordinator: an emergency stop is the axis's matter too
    Ticks clock_error;                  // now is at most so far off
};

/// A body or tail that the device has run, in machine coordinates: what the pulses can be checked against. From the
/// controller it is in machine time, as commanded; recorded in the device's, as given, with what was commanded beside
/// it (core/axis/device_time.hpp).
struct ExecutedTrack {
    Epoch epoch = 0;  // 0: the axis's own move
    FrameNumber frame = 0;
    bool tail = false;
    Tick start;
    Position from;
    std::vector<Piece> pieces;
    bool cut = false;             // pulses ceased early
    std::int64_t stop_count = 0;  // at its end
    std::int64_t zero_count = 0;
    Tick commanded_start;                // machine time
    std::vector<Ticks> commanded_ticks;  // of each piece, in machine time; one split at the end is one. Empty: as given
    Ticks clock_error;                   // each step is made within this, and two ticks, of the machine time commanded
};

/// Why a frame was not armed.
struct FailedCheck {
    bool too_late = false;        // the check was
    bool held = false;            // by this axis
    AxisSet lacking = 0;          // axes without a fresh state that reports the frame as held
    bool no_coordinator = false;  // there is no evidence of the coordinator
};

/// What happened, for the log.
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
        PositionProved,   // the axis is homed by the position that was kept
        PositionUnproved  // it is not: why
    };
    Kind kind = Kind::Fault;
    FaultCode fault = FaultCode::None;
    std::uint64_t number = 0;          // a term, an epoch, a frame, a stage: as the kind says
    std::optional<FailedCheck> check;  // Vetoed: why
};

struct AxisOutputs {
    std::optional<AxisState> state;  // once a slot
    std::vector<DeviceOrder> orders;
    ReusedVector<ExecutedTrack> tracks;
    std::vector<AxisNotice> notices;
    std::optional<KeptPosition> rests;  // homed, after a run: to be kept for the process that comes after this one
    ClockView device_clock;             // in machine time: steps and tracks are recorded in the device's own
    bool device_changed = false;        // from this step on counts are those of another device, or power-up

    /// For the next loop: what the lists have taken of memory stays.
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
