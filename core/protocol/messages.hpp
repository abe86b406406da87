// What coordinator, axes and clients say to each other, as plain values. The services translate these to DDS.
#pragma once

#include <array>
#include <compare>
#include <cstdint>
#include <optional>
#include <span>
#include <string>
#include <vector>

#include "core/axis_set.hpp"
#include "core/overrides.hpp"
#include "core/path_place.hpp"
#include "core/program.hpp"
#include "core/program_devices.hpp"
#include "core/protocol/lease_holder.hpp"
#include "core/protocol/process_counts.hpp"
#include "core/protocol/record_counts.hpp"
#include "core/static_vector.hpp"
#include "core/step/segment.hpp"

namespace lockstep {

/// A sequence of frames that starts from rest. Never reused: it is its owner's term and a counter.
using Epoch = std::uint64_t;
/// Frames of an epoch are numbered from 1 without gaps.
using FrameNumber = std::uint64_t;
/// A period of the axes' state messages: machine time divided by the slot's length.
using Slot = std::int64_t;
/// Who speaks: new at every start of a process.
using Identity = std::uint64_t;

/// Whose turn it is to move the machine. All that an owner says carries it. Terms only rise: who takes a machine over
/// claims one above all that it has heard of; of two that claim the same number the later process counts as higher.
struct Term {
    std::uint64_t number = 0;  // machine time of the claim in ticks, or one more than the highest heard; 0: nobody's
    Identity coordinator = 0;
    auto operator<=>(const Term&) const = default;
};

/// The epochs of a term are numbered upwards from here.
constexpr Epoch first_epoch(const Term& term) { return term.number << 8; }
/// Whether an owner can have come to an epoch in its term: no other number is believed, lest it put an axis beyond all
/// epochs to come.
constexpr bool is_epoch_of(Epoch epoch, const Term& term) { return epoch - first_epoch(term) < Epoch{1} << 24; }

inline constexpr std::size_t kMaxBodyPieces = 212;  // per axis and frame; the planner keeps moves long enough
inline constexpr std::size_t kMaxTailPieces = 60;   // the planner keeps stops short enough

/// One axis's share of a frame. The tail starts where the body ends. An axis may need a piece more for its device
/// (core/axis/device/retime.hpp).
struct AxisTrack {
    Position from;
    StaticVector<Piece, kMaxBodyPieces + 1> body;
    StaticVector<Piece, kMaxTailPieces + 1> tail;
    bool operator==(const AxisTrack&) const = default;
};

/// Frame k: every axis's motion in [start, start + ticks), and the tail that brings it to rest from there.
struct Frame {
    Term term;
    Epoch epoch = 0;
    FrameNumber number = 0;
    Tick start;
    Ticks ticks;
    bool last = false;  // the epoch ends with this frame, at rest; the tail is empty
    std::vector<AxisTrack> axes;
    bool operator==(const Frame&) const = default;
};

/// The six states of an axis, and Fault.
enum class AxisPhase : std::uint8_t { Initialize, Standby, Accelerate, Cruise, Decelerate, Stop, Fault };

/// What an axis says of itself once a slot. It is all that others know of it.
struct AxisState {
    Identity identity = 0;
    std::uint32_t axis = 0;  // its place in the configuration
    Slot stamp = 0;
    Epoch epoch = 0;                  // the newest epoch it has taken frames of
    FrameNumber held = 0;             // every frame up to this one is held; 0: none
    std::optional<FrameNumber> veto;  // the lowest frame of the epoch that may not be run, merged from all heard
    FrameNumber ran = 0;              // the highest frame of the epoch the device has begun
    bool at_rest = true;
    bool homed = false;
    AxisPhase phase = AxisPhase::Initialize;
    std::uint16_t fault = 0;  // FaultCode; 0: none
    Position position;        // machine coordinates, as the pulses have it
    Velocity velocity;
    Tick tick;                               // when position and velocity were read
    std::int64_t following_error_steps = 0;  // encoder minus count, since it was homed
    std::uint64_t command_done = 0;          // the newest AxisCommand carried out or refused
    std::uint16_t command_fault = 0;         // why it was refused; 0: it was carried out
    std::uint64_t config_hash = 0;           // of the configuration it runs with
    std::uint64_t refused_frames = 0;        // since start
    Ticks clock_error;                       // its machine time is at most so far off
    Term term;                               // of the owner it follows: the highest it ever has
    bool hears_owner = false;                // within silence_slots
    std::uint16_t unproved = 0;  // FaultCode: why it did not know its position at its start; 0: it knows it now
    bool operator==(const AxisState&) const = default;
};

/// An axis asks what time it is. Answered at once, whatever the coordinator is doing; see core/clock.
struct ClockRequest {
    std::uint32_t axis = 0;
    Identity identity = 0;
    std::uint64_t sequence = 0;
    Tick sent;  // by the axis's own clock
    bool operator==(const ClockRequest&) const = default;
};

/// The request it answers, and when it came and went.
struct ClockReply {
    ClockRequest request;
    Tick received;  // machine time
    Tick answered;  // machine time
    bool operator==(const ClockReply&) const = default;
};

/// MoveOwn: to a place by itself, not coordinated with others. Halt: a move of its own is braked and given up. Jog: to
/// a place by itself, while the order is renewed.
enum class AxisCommandKind : std::uint8_t { Home, Reset, StopNow, MoveOwn, Halt, Jog };

/// Coordinator to one axis. Repeated each slot until the axis's state says it is done.
struct AxisCommand {
    Term term;
    std::uint64_t sequence = 0;  // rises within a term; an axis carries out each once
    std::uint32_t axis = 0;
    AxisCommandKind kind = AxisCommandKind::Home;
    std::int64_t target_steps = 0;  // MoveOwn, Jog: machine coordinates
    Ticks ticks;                    // MoveOwn: how long it lasts; 0: as fast as the axis's limits allow
    double speed_mm_s = 0;          // Jog: at most, above 0
    Tick until;                     // Jog: the axis begins to brake by then, unless a repetition names a later time
    bool operator==(const AxisCommand&) const = default;
};

/// Standby: who says so does not own the machine; the owner's word counts.
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

/// MoveOwn: axes to their places each by itself, not coordinated. Jog: axes by themselves, while clients hold their
/// keys.
enum class JobKind : std::uint8_t { Home, Move, Run, MoveOwn, Jog };

/// Positions of all axes in 64 bits: of two places that differ in any bit it differs but once in 2^64.
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

/// Where the machine comes to rest if no frame behind this one is run; frame 0: where the epoch starts.
struct FrameRest {
    FrameNumber frame = 0;
    PathPlace place;           // on the program
    bool last = false;         // the epoch ends with it
    std::uint64_t digest = 0;  // digest_of where each axis then rests
    bool operator==(const FrameRest&) const = default;
};

/// What the coordinator says of the machine once a slot; it also tells axes which vetoes the coordinator casts.
struct MachineState {
    Term term;  // Standby: the highest number known, and who stands by
    Slot stamp = 0;
    Tick tick;
    MachinePhase phase = MachinePhase::Waiting;
    std::uint16_t fault = 0;
    std::uint32_t fault_axis = 0;  // meaningful where fault is not 0 and names an axis
    Epoch epoch = 0;
    FrameNumber sent = 0;               // the highest frame sent
    std::optional<FrameNumber> veto;    // the coordinator's own, of this epoch
    std::uint64_t job = 0;              // counts the jobs done or begun since start
    std::optional<JobOutcome> outcome;  // of that job; nothing while it is in progress
    Term job_begun;                     // in which term: another owner may have gone on with it
    std::int32_t line = 0;              // of the G-code now in motion, or where a job ended before its end
    std::uint16_t job_fault = 0;  // FaultCode: why the program of the last job ended before its end; 0: it did not
    bool lacks_blocks = false;    // the machine waits for more of the program
    double progress = 0;          // 0 ... 1 of the job's planned time
    double remaining_s = 0;
    Overrides overrides;       // of what is planned from now on
    AxisSet axes_present = 0;  // those that are heard
    std::uint64_t config_hash = 0;
    ProgramDevices devices;          // what the words of programs have switched
    std::optional<HeldLease> lease;  // the writer's; nothing: every client may give commands
    // What another needs to go on with the job, while one is in motion:
    JobKind job_kind = JobKind::Run;
    std::uint64_t program = 0;      // Command::program of the job; 0: none is in motion
    std::uint32_t events_from = 0;  // the events of the program before this block have been published
    std::vector<FrameRest> rests;   // of the frames of the epoch that may be the last ones run, rising
    // Of the record; nobody decides by it:
    RecordCounts published;          // by this process
    std::uint64_t lost_records = 0;  // messages that it could not write
    ProcessCounts process;           // nobody decides by it either
    bool operator==(const MachineState&) const = default;
};

/// An event of a program that has happened. Published once; the state keeps what it switched.
struct PublishedEvent {
    Term term;
    std::uint64_t sequence = 0;  // rises within a term, without gaps
    std::uint64_t job = 0;
    Epoch epoch = 0;            // 0: no axis moved since the job began
    Tick tick;                  // when the motion came to its place; at rest: when it was published
    bool at_rest = false;       // its place is where the axes came to rest, or was passed on the way to there
    bool is_of_program = true;  // false: the job ended before its end, and the coordinator switched the device off
    std::uint32_t block = 0;    // of the program
    std::int32_t line = 0;      // of the G-code file; 0: none
    ProgramEvent event;
    bool operator==(const PublishedEvent&) const = default;
};

/// Override: feed and rapid of coordinated moves, from the next frame that is not made yet. Jog: the axes move while
/// the client repeats the command; each repetition renews it for MachineConfig::jog_hold_ticks. TakeLease: the client
/// becomes the writer, or one of its clients, and repeats the command to stay so. GiveLease: it is no more.
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
    std::uint32_t axis = 0;
    double speed_mm_s = 0;   // at most; its sign is the direction
    double distance_mm = 0;  // at most, above 0; 0: to the end of the travel
    bool operator==(const JogAxis&) const = default;
};

/// A client to the coordinator. Answered by a Reply with the same client and sequence; never replayed.
struct Command {
    Identity client = 0;
    std::uint64_t sequence = 0;
    CommandKind kind = CommandKind::Stop;
    AxisSet axes = 0;           // Home: which; none means all
    std::uint64_t program = 0;  // Move, Run, MoveOwn: the program sent before in chunks
    Ticks ticks;                // MoveOwn: how long each axis's move lasts; 0: as fast as its limits allow
    int feed_percent = 0;       // Override; 0: as it is
    int rapid_percent = 0;      // Override; 0: as it is
    std::vector<JogAxis> jogs;  // Jog: all axes that the client jogs from now on; none: it releases them
    LeaseHolder writer;         // who commands; its name and host only in TakeLease
    bool takes_over = false;    // TakeLease: from another writer, too
    bool operator==(const Command&) const = default;
};

/// A part of a program: Protobuf bytes with whole blocks. The parts' bytes in order are the program's. Each part is
/// answered by a Reply, also when it comes again.
struct ProgramChunk {
    Identity client = 0;
    std::uint64_t sequence = 0;
    std::uint64_t program = 0;
    std::uint32_t index = 0;
    std::uint32_t count = 0;          // how many parts there are; 0: more follow
    double share = 0;                 // of the program that has been sent with this part; 0: not known
    std::vector<std::uint8_t> bytes;  // none, and more follow: it is no part, but asks how many were taken
    std::uint64_t writer = 0;         // LeaseHolder::id of its sender
    bool operator==(const ProgramChunk&) const = default;
};

/// A ProgramChunk that was read. Parts are numbered from 0 and are taken in order.
struct ProgramPart {
    Identity client = 0;
    std::uint64_t sequence = 0;
    std::uint64_t program = 0;
    std::uint32_t index = 0;
    bool is_question = false;  // no part: how many parts were taken, and how many blocks are free
    bool is_last = false;
    double share = 0;  // of the program that is known with this part, 0 to 1; 0: its sender cannot say
    ProgramHead head;  // in part 0
    std::vector<Block> blocks;
    std::string cut;  // in the last part: why the program ends before its end; empty: this is its end
};

enum class ReplyStatus : std::uint8_t { Accepted, Refused };

struct Reply {
    Identity client = 0;
    std::uint64_t sequence = 0;
    ReplyStatus status = ReplyStatus::Accepted;
    std::uint16_t fault = 0;  // FaultCode of a refusal
    std::uint64_t job = 0;    // the job a command began; to a jog's renewal: 0 when it is over
    std::string text;         // what, where, the limit and the remedy, for a person
    // To a ProgramChunk:
    std::uint32_t parts = 0;        // of its program, taken so far: they are not sent again
    std::uint64_t free_blocks = 0;  // how many blocks more the coordinator takes now
    bool operator==(const Reply&) const = default;
};

}  // namespace lockstep
