// The inputs and outputs of one loop of the coordinator, as values.
#pragma once

#include <cstdint>
#include <memory>
#include <optional>
#include <span>
#include <string_view>
#include <vector>

#include "core/coordinator/epoch/epoch_end.hpp"
#include "core/coordinator/program/known_program.hpp"
#include "core/faults.hpp"
#include "core/protocol/messages.hpp"
#include "core/reused_optional.hpp"
#include "core/reused_vector.hpp"

namespace lockstep {

/// The record of a job. It suffices to repeat the job.
struct JobEvent {
    enum class Kind : std::uint8_t { Begun, EpochBegun, Ended, Overridden, Probed };
    Kind kind = Kind::Begun;
    std::uint64_t job = 0;
    JobKind job_kind = JobKind::Run;
    JobOutcome outcome = JobOutcome::Done;        // Ended
    std::shared_ptr<const KnownProgram> program;  // Begun; null for homing
    std::optional<std::uint64_t> program_id;      // Begun, Ended: MachineJob::program_id
    Epoch epoch = 0;                              // EpochBegun (frame 1 starts at `start`), Overridden, Probed
    Tick start;
    PathPlace place;                   // EpochBegun: where on the program it starts
    Overrides overrides;               // EpochBegun, Overridden
    FrameNumber behind = 0;            // Overridden: the last frame planned without these overrides
    AxisCounts start_counts;           // Begun
    AxisCounts plays;                  // Begun, EpochBegun: of all motors; empty: none has backlash
    std::optional<ProbeResult> probe;  // Probed
};

/// The next activity after the epoch in progress has come to rest. Later enumerators have priority.
enum class Intent : std::uint8_t { GoOn, Hold, Stop, Abort };

struct EpochOutcome {
    EpochEnd::Kind kind = EpochEnd::Kind::Complete;
    Intent intent = Intent::GoOn;
};

/// The action of a new owner on the job in progress.
enum class OnTakeover : std::uint8_t { Stop, Continue };

/// Why a job is not continued.
enum class TakeoverDoubt : std::uint8_t {
    NotAsked,          // OnTakeover::Stop
    NotRunning,        // held, paused, being stopped, or not a program
    Interrupted,       // a hold or stop was commanded meanwhile
    UnknownProgram,    // its program did not arrive here
    OtherPlan,         // what the owner published of it does not fit the program
    AxisInDoubt,       // missing, started again, not homed or in fault
    FramesDiffer,      // the axes did not run the same frames
    UnreceivedFrames,  // the axes ran frames for which no message of the owner was received
    Misplaced,         // an axis is not where its frames end
    Pulses,            // only the owner knew how many pulses of M69 are left
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
        Claimed,           // this coordinator owns the machine now
        StoodDown,         // another coordinator owns the machine
        JobCutShort,       // by the takeover, at line `number`; `doubt` says why it is not continued
        JobContinued,      // after the takeover, at line `number`
        ProgramLate,       // the axes rest on the path after frame `number` and wait for more of the program
        ProgramCut,        // the job ended at line `number`, where its known program ends; `fault` says why
        UnattendedRunsOn,  // the client of job `number` fell silent; the job runs on
        UnattendedHeld,    // the client of job `number` fell silent; the job is held
        HeldByInput,       // input `number` of the machine, which holds it, such as a door, closed in motion
        TouchInMotion      // input `number` of the machine, a probe's, touched in a motion that does not probe
    };
    Kind kind = Kind::Phase;
    FaultCode fault = FaultCode::None;
    std::uint64_t number = 0;  // an axis, an epoch, a phase, a term, a line, a frame, a job or an input, by kind
    TakeoverDoubt doubt = TakeoverDoubt::NotAsked;  // JobCutShort
};

struct CoordinatorInputs {
    Tick now;
    std::span<const AxisState> axes;
    std::span<const MachineState> others;  // coordinators of the same machine; its own states are left out by identity
    std::span<const Command> commands;
    std::span<const ProgramPart> parts;
};

/// A part of a program that was taken. The record keeps it.
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
    std::vector<std::size_t> transitions;   // rows of kMachineTransitions that happened
    std::optional<EpochOutcome> epoch_end;  // in the step that evaluated it
    bool must_quit = false;  // another coordinator is proved to own this machine, and this one must not stand by

    /// Prepares the next loop. The lists keep their memory.
    void clear() {
        state.reset();
        frames.clear();
        axis_commands.clear();
        replies.clear();
        taken.clear();
        jobs.clear();
        events.clear();
        notices.clear();
        transitions.clear();
        epoch_end.reset();
        must_quit = false;
    }
};

}  // namespace lockstep
