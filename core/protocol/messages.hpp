// The messages between coordinator, axes and clients, as plain values. The services translate them to DDS.
#pragma once

#include <compare>
#include <cstdint>
#include <optional>
#include <span>
#include <string>
#include <vector>

#include "core/faults.hpp"
#include "core/hardware/output_change.hpp"
#include "core/indices.hpp"
#include "core/overrides.hpp"
#include "core/path_place.hpp"
#include "core/pause.hpp"
#include "core/program.hpp"
#include "core/program_devices.hpp"
#include "core/protocol/homing_stage.hpp"
#include "core/protocol/lease_holder.hpp"
#include "core/protocol/process_counts.hpp"
#include "core/protocol/record_counts.hpp"
#include "core/static_vector.hpp"
#include "core/step/segment.hpp"

namespace lockstep {

/// A sequence of frames that starts from rest. Its number combines its owner's term and a counter, and is never reused.
using Epoch = std::uint64_t;
/// Frames of an epoch are numbered from 1 without gaps.
using FrameNumber = std::uint64_t;
/// A period of the axes' state messages: machine time divided by the slot's length.
using Slot = std::int64_t;
/// Identifies a process. Each start of a process has a new identity.
using Identity = std::uint64_t;

/// Says which coordinator owns the machine. Every message of an owner carries its term. Terms only rise. A coordinator
/// that takes a machine over claims a higher number than every term that it has received. If two claim the same number,
/// the term of the later process counts as higher.
struct Term {
    std::uint64_t number = 0;  // machine time of the claim in ticks, or one more than the highest received; 0: no owner
    Identity coordinator = 0;
    auto operator<=>(const Term&) const = default;
};

/// The epochs of a term are numbered upwards from here.
constexpr Epoch first_epoch(const Term& term) { return term.number << 8; }
/// Whether an epoch can belong to this term. Other numbers are refused. An axis that accepted one might refuse all
/// epochs to come.
constexpr bool is_epoch_of(Epoch epoch, const Term& term) { return epoch - first_epoch(term) < Epoch{1} << 24; }

inline constexpr std::size_t kMaxBodyPieces = 212;  // per axis and frame; the planner makes moves long enough for it
inline constexpr std::size_t kMaxTailPieces = 60;   // the planner makes stops short enough for it

/// One axis's share of a frame. The tail starts where the body ends. An axis may need one more piece in each for its
/// device (core/axis/device/retime.hpp).
struct AxisTrack {
    Position from;
    StaticVector<Piece, kMaxBodyPieces + 1> body;
    StaticVector<Piece, kMaxTailPieces + 1> tail;
    bool operator==(const AxisTrack&) const = default;
};

/// The changes of outputs of one motor's device in a frame.
struct MotorOutputs {
    std::uint32_t motor = 0;
    OutputTrack track;
    bool operator==(const MotorOutputs&) const = default;
};

/// An input of a probe.
struct TouchInput {
    MotorIndex motor;          // whose device has it
    std::uint8_t channel = 0;  // of the device
    bool operator==(const TouchInput&) const = default;

    /// `closed`: the closed inputs of the device; input n is bit n.
    bool is_closed(std::uint32_t closed) const { return (closed >> channel & 1) != 0; }
};

inline constexpr std::size_t kMaxTouchInputs = 8;  // of one probe

/// The inputs whose change ends an epoch of frames. The first touch of any of them counts.
struct TouchInputs {
    StaticVector<TouchInput, kMaxTouchInputs> any_of;  // empty: the epoch ends at no touch
    bool opens = false;                                // they touch when they open
    bool ceases =
        false;  // all see one switch, and the pulses of their devices cease at the touch: no other motor moves
    bool operator==(const TouchInputs&) const = default;

    bool empty() const { return any_of.empty(); }
    /// The input at whose touch the motor's pulses cease; nullopt if they do not.
    std::optional<TouchInput> ceasing(MotorIndex motor) const {
        for (const TouchInput& input : any_of) {
            if (ceases && input.motor == motor) { return input; }
        }
        return std::nullopt;
    }
    /// `closed`: as in TouchInput.
    bool is_touched(const TouchInput& input, std::uint32_t closed) const { return input.is_closed(closed) != opens; }
};

/// The touch that ended an epoch.
struct EpochTouch {
    Epoch epoch = 0;
    Tick tick;                 // machine time
    std::uint8_t channel = 0;  // the input of the device that touched
    bool operator==(const EpochTouch&) const = default;
};

/// Frame k: every axis's motion in [start, start + ticks), and the tail that brings it to rest from there.
struct Frame {
    Term term;
    Epoch epoch = 0;
    FrameNumber number = 0;
    Tick start;
    Ticks ticks;
    bool last = false;  // the epoch ends with this frame, at rest; the tail is empty
    TouchInputs touch;  // the epoch also ends at a touch of these
    std::vector<AxisTrack> axes;
    std::vector<MotorOutputs> outputs;  // of the motors whose devices have outputs, in order
    bool operator==(const Frame&) const = default;

    /// nullptr: the motor's device has no outputs.
    const OutputTrack* outputs_of(MotorIndex motor) const {
        for (const MotorOutputs& of : outputs) {
            if (of.motor == motor) { return &of.track; }
        }
        return nullptr;
    }
};

/// The six states of an axis, and Fault.
enum class AxisPhase : std::uint8_t { Initialize, Standby, Accelerate, Cruise, Decelerate, Stop, Fault };

/// The switches of an axis. True: the switch is closed.
struct Switches {
    bool limit_min = false;
    bool limit_max = false;
    bool home = false;
    bool any() const { return limit_min || limit_max || home; }
    bool operator==(const Switches&) const = default;
};

/// The state that an axis publishes once a slot. Others know nothing else of the axis.
struct AxisState {
    Identity identity = 0;
    std::uint32_t axis = 0;  // the place of its motor
    Slot stamp = 0;
    Epoch epoch = 0;                  // the newest epoch it has taken frames of
    FrameNumber held = 0;             // every frame up to this one is held; 0: none
    std::optional<FrameNumber> veto;  // the lowest frame of the epoch that may not be run, merged from all received
    FrameNumber ran = 0;              // the highest frame of the epoch the device has begun
    bool at_rest = true;
    bool homed = false;
    AxisPhase phase = AxisPhase::Initialize;
    FaultCode fault = FaultCode::None;
    Position position;  // machine coordinates, by its pulses
    Velocity velocity;
    Tick tick;                                  // when position and velocity were read
    std::int64_t following_error_steps = 0;     // encoder minus count, since it was homed
    std::uint32_t corrected_steps = 0;          // lost since it was homed, and made up at rest
    std::int64_t play_steps = 0;                // the motor's place minus its slide's, because of its backlash
    std::uint64_t command_done = 0;             // the newest AxisCommand carried out or refused
    FaultCode command_fault = FaultCode::None;  // why it was refused; None: it was carried out
    std::uint64_t config_hash = 0;              // of the configuration it runs with
    std::uint64_t refused_frames = 0;           // since start
    Ticks clock_error;                          // bound on the error of its machine time
    Term term;                                  // of the owner it follows; never lower than before
    bool hears_owner = false;                   // it received its owner within silence_slots
    FaultCode unproved = FaultCode::None;       // why it did not know its position at its start; None: it knows it now
    Switches switches;
    HomingStage homing = HomingStage::Idle;  // of an axis that homes by itself. For people: no decision depends on it
    std::uint32_t inputs = 0;                // all closed inputs of its device; input n is bit n
    std::uint16_t outputs = 0;               // all digital outputs of its device that are on; output n is bit n
    std::uint32_t pulses_left = 0;           // of the newest places at its device: so many were not made, so far
    AnalogLevels analog{};                   // what the analog outputs of its device show
    std::optional<EpochTouch> touch;         // of the newest epoch, if it ends at an input of this device
    bool ceased = false;                     // and its pulses ceased at that touch, before its frames ended
    bool operator==(const AxisState&) const = default;

    MotorIndex motor() const { return MotorIndex{axis}; }
};

/// An axis asks for machine time. The coordinator's process answers at once, independently of its loop; see core/clock.
struct ClockRequest {
    std::uint32_t axis = 0;
    Identity identity = 0;
    std::uint64_t sequence = 0;
    Tick sent;  // by the axis's own clock
    bool operator==(const ClockRequest&) const = default;
};

/// The answered request, and the times at which the request arrived and the reply left.
struct ClockReply {
    ClockRequest request;
    Tick received;  // machine time
    Tick answered;  // machine time
    bool operator==(const ClockReply&) const = default;
};

/// MoveOwn: the axis moves to a place by itself, not coordinated with others. Halt: it brakes and abandons a move of
/// its own. Jog: it moves to a place by itself while the order is renewed. Approach: it moves to its home switch and
/// waits there, for the other motors of its axis. Assume: it takes frames as if it rested at a place, to be homed by
/// them. TakePlace: it truly rests there, so it is homed. Correct: it rests at a place by its count, and makes up the
/// steps that its encoder shows as lost.
enum class AxisCommandKind : std::uint8_t {
    Home,
    Reset,
    StopNow,
    MoveOwn,
    Halt,
    Jog,
    Approach,
    Assume,
    TakePlace,
    Correct
};

/// An order of the coordinator to one axis. It is repeated each slot until the axis's state reports it as done.
struct AxisCommand {
    Term term;
    std::uint64_t sequence = 0;  // rises within a term; an axis carries out each once
    std::uint32_t axis = 0;
    AxisCommandKind kind = AxisCommandKind::Home;
    std::int64_t target_steps = 0;  // MoveOwn, Jog, Assume, TakePlace, Correct: machine coordinates
    std::optional<Ticks> ticks;     // MoveOwn: how long it lasts; nullopt: as fast as the axis's limits allow
    double speed_mm_s = 0;          // Jog: the greatest speed, above 0
    Tick until;                     // Jog: the axis begins to brake by then, unless a repetition names a later time
    bool operator==(const AxisCommand&) const = default;
};

/// Standby: the coordinator that publishes it does not own the machine. The owner's phase counts.
enum class MachinePhase : std::uint8_t {
    Waiting,
    Idle,
    Homing,
    Running,
    Holding,
    Paused,
    Stopping,
    Fault,
    Standby,
    Jogging
};

enum class JobOutcome : std::uint8_t { Done, Stopped, Failed };

/// MoveOwn: axes move to their places, each by itself, not coordinated. Jog: axes move by themselves while clients hold
/// their keys. Return: axes go back to the place of a pause. Jog and Return may be a part of another job's pause.
enum class JobKind : std::uint8_t { Home, Move, Run, MoveOwn, Jog, Return };

/// Hashes the positions of all axes into 64 bits. Two different places have the same digest only once in 2^64 cases.
constexpr std::uint64_t digest_of(std::span<const Position> positions) {
    std::uint64_t digest = 0xcbf29ce484222325U;
    for (const Position position : positions) {
        for (const std::uint64_t word : {static_cast<std::uint64_t>(position.count()), position.phase()}) {
            digest = (digest ^ word) * 0x9e3779b97f4a7c15U;
            digest ^= digest >> 32;
        }
    }
    return digest;
}

inline constexpr std::size_t kMaxRests = 64;  // far more frames than can be in flight

/// Where the machine comes to rest if no frame after this one is run. Frame 0: where the epoch starts.
struct FrameRest {
    FrameNumber frame = 0;
    PathPlace place;           // on the program
    bool last = false;         // the epoch ends with it
    std::uint64_t digest = 0;  // digest_of the positions at which the axes then rest
    bool operator==(const FrameRest&) const = default;
};

/// A job that waits for a person. Meanwhile axes may be jogged. Before the job goes on, they return to `place`.
struct MachinePause {
    Pause why;
    StaticVector<std::int64_t, kMaxAxes> place;  // of each axis of the machine, in steps: where the job goes on
    double wait_left_s = 0;                      // Input: until the wait times out
    bool operator==(const MachinePause&) const = default;
};

/// How the newest probing move ended.
struct ProbeResult {
    std::uint64_t job = 0;
    std::optional<std::uint32_t> input;        // of the machine, that touched first; empty: none touched
    Tick tick;                                 // of the touch
    StaticVector<double, kMaxAxes> places_mm;  // of each axis of the machine at the touch; without one, at rest
    bool operator==(const ProbeResult&) const = default;

    bool touched() const { return input.has_value(); }
};

/// The axis that moves of all axes home, and how far.
struct HomedByTouch {
    std::uint32_t axis = 0;
    HomingStage stage = HomingStage::Idle;
    bool operator==(const HomedByTouch&) const = default;
};

/// The state of the machine that the coordinator publishes once a slot. It also carries the coordinator's veto.
struct MachineState {
    Term term;  // Standby: the highest number known, and the standby's identity
    Slot stamp = 0;
    Tick tick;
    MachinePhase phase = MachinePhase::Waiting;
    FaultCode fault = FaultCode::None;
    std::optional<MotorIndex> fault_motor;  // if `fault` is of one
    Epoch epoch = 0;
    FrameNumber sent = 0;                   // the highest frame sent
    std::optional<FrameNumber> veto;        // the coordinator's own, of this epoch
    std::uint64_t job = 0;                  // number of the newest job, done or in progress
    std::optional<JobOutcome> outcome;      // of that job; empty while it is in progress
    Term job_begun;                         // the term in which it began; another owner may have continued it
    std::optional<std::int32_t> line;       // the G-code line now in motion, or the line at which a job ended early
    FaultCode job_fault = FaultCode::None;  // why the program of the last job ended early; None: it did not
    bool lacks_blocks = false;              // the machine waits for more of the program
    double progress = 0;                    // 0 ... 1 of the job's planned time
    double remaining_s = 0;
    Overrides overrides;      // for what is planned from now on
    MotorSet motors_present;  // those whose processes the coordinator receives
    std::uint64_t config_hash = 0;
    ProgramDevices devices;  // as the words of programs have switched them
    std::optional<Epoch>
        devices_after;               // at rest after this epoch or an earlier one, they hold; empty: axes follow frames
    std::optional<HeldLease> lease;  // the writer's; empty: every client may give commands
    std::optional<MachinePause> pause;  // of the job; present also while axes are jogged and return in the pause
    std::optional<ProbeResult> probe;
    // Another coordinator needs these to continue the job in motion:
    JobKind job_kind = JobKind::Run;
    std::optional<std::uint64_t> program;           // Command::program of the job; nullopt: none is in motion
    StaticVector<std::int64_t, kMaxAxes> leg_from;  // of each axis, in steps: where the leg of these frames began
    std::uint32_t events_from = 0;                  // the events of the program before this block have been published
    StaticVector<FrameRest, kMaxRests> rests;       // of the frames of the epoch that may be the last one run, in order
    // For people and for checks of the record. No decision depends on it:
    std::optional<HomedByTouch> homing;
    RecordCounts published;          // record messages published by this process
    std::uint64_t lost_records = 0;  // record messages that it could not write
    ProcessCounts process;           // of this process
    bool operator==(const MachineState&) const = default;
};

/// A program event that has happened. It is published once. MachineState::devices keeps its effect.
struct PublishedEvent {
    Term term;
    std::uint64_t sequence = 0;  // rises within a term, without gaps
    std::uint64_t job = 0;
    Epoch epoch = 0;            // 0: no axis moved since the job began
    Tick tick;                  // when the motion reached its place; at rest: when it was published
    bool at_rest = false;       // the event's place is where the axes came to rest, or they passed it on the way there
    bool is_of_program = true;  // false: the job ended early, and the coordinator switched the device off
    std::uint32_t block = 0;    // of the program
    std::optional<std::int32_t> line;  // of the G-code file
    ProgramEvent event;
    bool operator==(const PublishedEvent&) const = default;
};

/// Override: sets feed and rapid of coordinated moves from the next frame to be made. Jog: the axes move while the
/// client repeats the command; each repetition renews it for MachineConfig::jog_hold_ticks. TakeLease: the client
/// becomes the writer, or one of the writer's clients, and repeats the command to stay so. GiveLease: the client gives
/// the lease up.
enum class CommandKind : std::uint8_t {
    Home,
    Move,
    Run,
    Hold,
    Resume,
    Stop,
    EmergencyStop,
    Reset,
    MoveOwn,
    Override,
    Jog,
    TakeLease,
    GiveLease
};

/// One axis of a jog.
struct JogAxis {
    AxisIndex axis;
    double speed_mm_s = 0;              // the greatest speed; its sign is the direction
    std::optional<double> distance_mm;  // the greatest distance, above 0; nullopt: to the end of the travel
    bool operator==(const JogAxis&) const = default;
};

/// A command of a client to the coordinator. It is answered by a Reply with the same client and sequence, and never
/// replayed.
struct Command {
    Identity client = 0;
    std::uint64_t sequence = 0;
    CommandKind kind = CommandKind::Stop;
    AxisSet axes;                      // Home: the axes to home; none means all
    std::uint64_t program = 0;         // Move, Run, MoveOwn: the program that was sent before in chunks
    std::optional<Ticks> ticks;        // MoveOwn: how long each axis's move lasts; nullopt: as fast as its limits allow
    std::optional<int> feed_percent;   // Override; nullopt: unchanged
    std::optional<int> rapid_percent;  // Override; nullopt: unchanged
    std::vector<JogAxis> jogs;         // Jog: all axes that the client jogs from now on; empty: it releases them
    LeaseHolder writer;                // the sender; its name and host only in TakeLease
    bool takes_over = false;           // TakeLease: even from another writer
    bool returns = false;              // Resume: axes that were jogged in a pause first return to its place
    bool operator==(const Command&) const = default;
};

/// A part of a program: Protobuf bytes with whole blocks. The bytes of all parts in order are the program. Each part is
/// answered by a Reply, also when it is repeated.
struct ProgramChunk {
    Identity client = 0;
    std::uint64_t sequence = 0;
    std::uint64_t program = 0;
    std::uint32_t index = 0;
    std::optional<std::uint32_t> count;  // how many parts there are; nullopt: more follow
    std::optional<double> share;  // fraction of the program sent so far, with this part, above 0; nullopt: not known
    std::vector<std::uint8_t> bytes;  // empty while more follow: this is not a part, but asks how many were taken
    std::uint64_t writer = 0;         // LeaseHolder::id of its sender
    bool operator==(const ProgramChunk&) const = default;
};

/// A decoded ProgramChunk. Parts are numbered from 0 and are taken in order.
struct ProgramPart {
    Identity client = 0;
    std::uint64_t sequence = 0;
    std::uint64_t program = 0;
    std::uint32_t index = 0;
    bool is_question = false;  // this is not a part, but asks how many parts were taken and how many blocks are free
    bool is_last = false;
    std::optional<double> share;  // ProgramChunk::share
    ProgramHead head;             // in part 0
    std::vector<Block> blocks;
    std::string cut;  // in the last part: why the program ends early; empty: this is its end
};

enum class ReplyStatus : std::uint8_t { Accepted, Refused };

struct Reply {
    Identity client = 0;
    std::uint64_t sequence = 0;
    ReplyStatus status = ReplyStatus::Accepted;
    FaultCode fault = FaultCode::None;  // of a refusal
    std::uint64_t job = 0;              // the job that a command began; for a jog's renewal: 0 when the jog is over
    std::string text;                   // what, where, the limit and the remedy, for a person
    // To a ProgramChunk:
    std::uint32_t parts = 0;        // parts of the program taken so far; the client does not send these again
    std::uint64_t free_blocks = 0;  // how many more blocks the coordinator takes now
    bool operator==(const Reply&) const = default;
};

}  // namespace lockstep
