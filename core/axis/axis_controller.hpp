// One axis, as a state machine fed with messages and time: `step` is all there is to it.
//
// What it is given each loop: the time, one look at its device, and every message that came. What it gives back: orders
// for the device, its state once a slot, and a record of what was run. It does no I/O and reads no clock.
#pragma once

#include <deque>
#include <optional>
#include <span>
#include <vector>

#include "core/axis/device/device.hpp"
#include "core/axis/device/position_claim.hpp"
#include "core/axis/following/setpoint_follower.hpp"
#include "core/axis/fsm.hpp"
#include "core/axis/own_moves/homing.hpp"
#include "core/axis/own_moves/own_move.hpp"
#include "core/clock/clock_view.hpp"
#include "core/protocol/client_memory.hpp"
#include "core/protocol/second_hearing.hpp"

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
    std::uint64_t number = 0;               // a term, an epoch, a frame, a stage: as the kind says
    std::optional<FailedCheck> check = {};  // Vetoed: why
};

struct AxisOutputs {
    std::optional<AxisState> state;  // once a slot
    std::vector<DeviceOrder> orders;
    std::vector<ExecutedTrack> tracks;
    std::vector<AxisNotice> notices;
    std::optional<KeptPosition> rests;  // homed, after a run: to be kept for the process that comes after this one
    ClockView device_clock;             // in machine time: steps and tracks are recorded in the device's own
    bool device_changed = false;        // from this step on counts are those of another device, or power-up
};

using TransitionCounts = std::array<std::uint64_t, kAxisTransitions.size()>;

class AxisController {
public:
    /// `identity` is new at every start of the process. `begin_steps`: the methods of the axis's own moves. `kept`:
    /// what the process before it has left of the position.
    AxisController(std::size_t axis, const MachineConfig& machine, Identity identity, std::uint64_t config_hash,
                   BeginSteps begin_steps, KeptOrNot kept);

    AxisOutputs step(const AxisInputs& inputs);

    AxisPhase phase() const { return phase_; }
    bool homed() const { return homed_; }
    bool at_rest() const { return mode_ == Mode::Rest && !device_.moving; }
    /// How often each row of kAxisTransitions has been taken.
    const TransitionCounts& transitions() const { return transitions_; }
    /// Machine coordinates are the device's counts minus this.
    std::int64_t zero_count() const { return zero_count_; }

private:
    struct LocalRun {
        LocalMove move;
        OwnMove frames;                    // those to come
        std::deque<HeldFrame> held;        // those loaded and not yet recorded
        std::optional<HeldFrame> waiting;  // made, but the device's ring has no room for it
        std::int64_t target = 0;           // the device's count at its end
        int tries = 0;
        bool halted = false;

        const HeldFrame* find(FrameNumber number) const;
    };
    enum class Mode : std::uint8_t { Rest, Following, Local };

    void look(const AxisInputs& inputs, AxisOutputs& out);
    void claim_position(const AxisInputs& inputs, AxisOutputs& out);
    std::optional<KeptPosition> position_to_keep();
    void observe(const DeviceStatus& device, AxisOutputs& out);
    void lose_device(AxisOutputs& out);
    void veto_when_left_behind(const DeviceStatus& device, AxisOutputs& out);
    void veto_for_own_reasons(AxisOutputs& out);
    void record_progress(const DeviceStatus& device, AxisOutputs& out);
    void record_end(const HeldFrame& frame, const DeviceStatus& device, AxisOutputs& out);
    void record(const HeldFrame& frame, bool tail, std::optional<std::int64_t> cut_at, AxisOutputs& out);
    void follow_speed(const DeviceStatus& device);
    void end_run(const DeviceStatus& device, AxisOutputs& out);
    void end_following(AxisOutputs& out);

    void hear(const AxisInputs& inputs, AxisOutputs& out);
    bool follows(const MachineState& state, Slot now, AxisOutputs& out);
    void adopt(const Term& term, Slot now, AxisOutputs& out);
    bool hears_owner(Slot now) const;
    bool is_from_owner(const Term& term) const { return owner_ != Term{} && rules::is_from_owner(term, owner_); }
    bool is_news(const Command& request);
    void stop_now(AxisOutputs& out);
    void carry_out(const AxisCommand& command, const DeviceStatus& device, AxisOutputs& out);
    void begin_homing(const AxisCommand& command, const DeviceStatus& device, AxisOutputs& out);
    void reset(AxisOutputs& out);
    void refuse(const AxisCommand& command, FaultCode why, AxisOutputs& out);
    void done(FaultCode fault);

    void take_frames(const AxisInputs& inputs, AxisOutputs& out);
    void begin_following(Epoch epoch, AxisOutputs& out);
    void load(const HeldFrame& frame, AxisOutputs& out) const;

    // axis_own_moves.cpp
    void begin_own_move(const AxisCommand& command, const DeviceStatus& device, AxisOutputs& out);
    FaultCode refusal_of(const AxisCommand& command, std::int64_t steps) const;
    void take_homing_step(const HomingStep& step, AxisOutputs& out);
    void start_local(const LocalMove& move, int tries, AxisOutputs& out);
    void watch_owner(Slot now, AxisOutputs& out);
    void feed_local(AxisOutputs& out);
    void halt_local(AxisOutputs& out);
    void end_local(const DeviceStatus& device, AxisOutputs& out);
    bool goes_on(const LocalRun& ended, const DeviceStatus& device, AxisOutputs& out);
    void abandon_local();
    void end_own_move(const DeviceStatus& device, AxisOutputs& out);
    bool is_homing() const { return homing_.stage() != HomingStage::Idle; }
    OwnMove own_move(const LocalMove& move, Tick start) const;

    void happen(AxisEvent event);
    void fail(FaultCode fault, AxisOutputs& out);
    bool may_follow() const {
        return homed_ && mode_ == Mode::Rest && phase_ == AxisPhase::Standby && fault_ == FaultCode::None;
    }
    std::int64_t following_error() const { return device_.encoder_count - device_.position.count() - encoder_zero_; }
    Position machine_position(Position device) const { return device - Displacement::steps(zero_count_); }
    AxisState state(Slot slot) const;

    static constexpr int kMaxTries = 10;

    std::size_t axis_;
    MachineConfig machine_;
    AxisLimits limits_;
    Identity identity_;
    std::uint64_t config_hash_;
    BeginSteps begin_steps_;
    Ticks slot_;
    SetpointFollower follower_;
    Homing homing_;

    Mode mode_ = Mode::Rest;
    AxisPhase phase_ = AxisPhase::Initialize;
    TransitionCounts transitions_{};
    FaultCode fault_ = FaultCode::None;
    bool homed_ = false;
    std::int64_t zero_count_ = 0;
    std::int64_t encoder_zero_ = 0;  // of the encoder minus the count, at the homing
    KeptOrNot kept_;                 // the newest, for when a device is found
    bool has_device_ = false;
    FaultCode unproved_ = FaultCode::DeviceMissing;
    std::uint64_t kept_run_ = 0;  // the position after it has been said
    std::uint64_t run_ = 0;       // the device run begun last
    FrameNumber recorded_ = 0;    // bodies of the run recorded so far
    FrameNumber ran_ = 0;         // bodies of the epoch begun so far
    std::optional<LocalRun> local_;
    std::size_t ring_room_ = 0;  // of the device's segment ring, in this loop
    double last_speed_ = 0;

    DeviceStatus device_;
    Tick now_;
    Ticks clock_error_;
    std::optional<Slot> state_slot_;
    Term owner_;  // the highest ever followed
    Slot owner_heard_ = 0;
    TermHearing claimants_;
    ClientMemory<std::uint64_t> stops_taken_;  // the newest emergency stop of each client
    std::uint64_t command_taken_ = 0;
    std::uint64_t command_done_ = 0;
    FaultCode command_fault_ = FaultCode::None;
    bool command_open_ = false;
    std::uint64_t refused_frames_ = 0;
    FaultCode last_refusal_ = FaultCode::None;
};

}  // namespace lockstep
