// What one loop of the coordinator takes, and what it gives back, as values.
#pragma once

#include <cstdint>
#include <memory>
#include <optional>
#include <span>
#include <string_view>
#include <vector>

#include "core/coordinator/path/epoch_runner.hpp"
#include "core/coordinator/program/known_program.hpp"
#include "core/faults.hpp"
#include "core/protocol/messages.hpp"
#include "core/reused_optional.hpp"
#include "core/reused_vector.hpp"

namespace lockstep {

/// What the record says of a job: enough to do it again.
struct JobEvent {
    enum class Kind : std::uint8_t { Begun, EpochBegun, Ended, Overridden };
    Kind kind = Kind::Begun;
    std::uint64_t job = 0;
    JobKind job_kind = JobKind::Run;
    JobOutcome outcome = JobOutcome::Done;        // Ended
    std::shared_ptr<const KnownProgram> program;  // Begun; null for homing
    std::uint64_t program_id = 0;                 // its Command::program; of Ended too
    Epoch epoch = 0;                              // EpochBegun: its frame 1 starts at `start`; Overridden: in it
    Tick start;
    PathPlace place;          // EpochBegun: where on the program it starts
    Overrides overrides;      // EpochBegun, Overridden
    FrameNumber behind = 0;   // Overridden: the last frame planned without these overrides
    AxisCounts start_counts;  // Begun
};

/// What is to follow when the epoch in progress has come to rest. The later ones win.
enum class Intent : std::uint8_t { GoOn, Hold, Stop, Abort };

struct EpochOutcome {
    EpochEnd::Kind kind = EpochEnd::Kind::Complete;
    Intent intent = Intent::GoOn;
};

/// What a new owner does with the job in progress.
enum class OnTakeover : std::uint8_t { Stop, Continue };

/// Why a job is not gone on with.
enum class TakeoverDoubt : std::uint8_t {
    NotAsked,          // OnTakeover::Stop
    NotRunning,        // held, paused, being stopped, or not a program
    Interrupted,       // a hold or stop was asked for meanwhile
    UnknownProgram,    // it did not arrive here
    OtherPlan,         // what the owner said of it does not fit the program
    AxisInDoubt,       // missing, started again, not homed or in fault
    FramesDiffer,      // the axes did not run the same frames
    UnreceivedFrames,  // they ran frames of which the owner's word was not heard
    Misplaced,         // one is not where its frames end
};
std::string_view text_of(TakeoverDoubt doubt);

struct CoordinatorNotice {
    enum class Kind : std::uint8_t {
        Phase,
        Fault,
        AxisSeen,
        AxisGone,
        Interrupted,
        EpochBegun,
        Claimed,       // it owns the machine now
        StoodDown,     // another does
        JobCutShort,   // by the takeover: where, and why it is not gone on with
        JobContinued,  // after the takeover: where
        ProgramLate,   // the axes rest on the path and wait for more of the program; behind which frame
        ProgramCut     // the job ended with what is known of its program: at which line, and why
    };
    Kind kind = Kind::Phase;
    FaultCode fault = FaultCode::None;
    std::uint64_t number = 0;                       // an axis, an epoch, a phase, a term, a line: as the kind says
    TakeoverDoubt doubt = TakeoverDoubt::NotAsked;  // JobCutShort
};

struct CoordinatorInputs {
    Tick now;
    std::span<const AxisState> axes;
    std::span<const MachineState> others;  // coordinators of the same machine; its own states are left out by identity
    std::span<const Command> commands;
    std::span<const ProgramPart> parts;
};

/// A part of a program that was taken: the record keeps it.
struct TakenPart {
    std::uint64_t program = 0;
    std::uint32_t index = 0;
};

struct CoordinatorOutputs {
    ReusedOptional<MachineState> state;  // once a slot
    ReusedVector<Frame> frames;
    std::vector<AxisCommand> axis_commands;
    std::vector<Reply> replies;
    std::vector<TakenPart> taken;
    std::vector<JobEvent> jobs;
    std::vector<PublishedEvent> events;
    std::vector<CoordinatorNotice> notices;
    std::optional<EpochOutcome> epoch_end;  // in the step that judged it
    bool must_quit = false;  // another coordinator proved to own this machine, and this one was not to stand by

    /// For the next loop: what the lists have taken of memory stays.
    void clear() {
        state.reset();
        frames.clear();
        axis_commands.clear();
        replies.clear();
        taken.clear();
        jobs.clear();
        events.clear();
        notices.clear();
        epoch_end.reset();
        must_quit = false;
    }
};

}  // namespace lockstep
