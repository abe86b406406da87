// The coordinator as a state machine fed with messages and time: plans jobs, runs their epochs, homes axes, answers
// clients. `step` is all there is to it; it does no I/O and reads no clock.
#pragma once

#include <map>
#include <memory>
#include <optional>
#include <span>
#include <string>
#include <vector>

#include "core/coordinator/epoch_runner.hpp"
#include "core/coordinator/ownership.hpp"
#include "core/coordinator/program_plan.hpp"
#include "core/coordinator/takeover.hpp"
#include "core/faults.hpp"
#include "core/machine.hpp"
#include "core/motion/step_source.hpp"
#include "core/program.hpp"
#include "core/protocol/client_memory.hpp"
#include "core/protocol/messages.hpp"

namespace lockstep {

/// What the record says of a job: enough to do it again.
struct JobEvent {
    enum class Kind : std::uint8_t { Begun, EpochBegun, Ended, Overridden };
    Kind kind = Kind::Begun;
    std::uint64_t job = 0;
    JobKind job_kind = JobKind::Run;
    JobOutcome outcome = JobOutcome::Done;   // Ended
    std::shared_ptr<const Program> program;  // Begun; null for homing
    std::uint64_t program_id = 0;            // its Command::program
    Epoch epoch = 0;                         // EpochBegun: its frame 1 starts at `start`; Overridden: in it
    Tick start;
    PathPlace place;                         // EpochBegun: where on the program it starts
    Overrides overrides;                     // EpochBegun, Overridden
    FrameNumber behind = 0;                  // Overridden: the last frame planned without these overrides
    std::vector<std::int64_t> start_counts;  // Begun
};

/// What is to follow when the epoch in progress has come to rest. The later ones win.
enum class Intent : std::uint8_t { GoOn, Hold, Stop, Abort };

struct EpochOutcome {
    EpochEnd::Kind kind = EpochEnd::Kind::Complete;
    Intent intent = Intent::GoOn;
};

struct CoordinatorNotice {
    enum class Kind : std::uint8_t {
        Phase,
        Fault,
        AxisSeen,
        AxisGone,
        Interrupted,
        EpochBegun,
        Claimed,      // it owns the machine now
        StoodDown,    // another does
        JobCutShort,  // by the takeover: where, and why it is not gone on with
        JobContinued  // after the takeover: where
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
};

struct CoordinatorOutputs {
    std::optional<MachineState> state;  // once a slot
    std::vector<Frame> frames;
    std::vector<AxisCommand> axis_commands;
    std::vector<Reply> replies;
    std::vector<JobEvent> jobs;
    std::vector<CoordinatorNotice> notices;
    std::optional<EpochOutcome> epoch_end;  // in the step that judged it
    bool must_quit = false;  // another coordinator proved to own this machine, and this one was not to stand by
};

class Coordinator {
public:
    /// `identity` is the machine time of its start in ticks, and so new at every start. It listens before it claims the
    /// machine; where another owns it, it stands by if it is told what to do on a takeover. `begin_steps`: the methods
    /// of the axes' own moves.
    Coordinator(const MachineConfig& machine, Identity identity, std::uint64_t config_hash, BeginSteps begin_steps,
                std::optional<OnTakeover> standby = std::nullopt);

    /// A program that has arrived whole; Command::program names it. Only the newest few are kept.
    void accept_program(std::uint64_t id, Program program);

    CoordinatorOutputs step(const CoordinatorInputs& inputs);

    MachinePhase phase() const { return phase_; }
    bool owns_machine() const { return ownership_.owns(); }
    /// Its own where it owns the machine; else the highest that is known.
    Term term() const { return ownership_.term(); }

private:
    struct Job {
        std::uint64_t number = 0;
        JobKind kind = JobKind::Run;
        std::uint64_t program_id = 0;  // Command::program
        std::shared_ptr<const Program> program;
        std::vector<Leg> legs;
        std::size_t leg = 0;
        Subticks run;         // epochs done
        double progress = 0;  // 0 ... 1: never falls, though what is left is planned anew
        Subticks counted;     // of its run, in `progress`
        AxisSet axes = 0;     // homing: which
        int sequence = 0;     // homing: the group in progress
        PathPlace resume;     // held or interrupted: where it goes on
        std::vector<PathMove> remaining;
        std::vector<Position> positions;
        int fruitless = 0;  // epochs in a row that ran no frame
        // Own moves, by axis:
        std::vector<std::int64_t> from;
        std::vector<std::int64_t> to;
        Tick begun;
        double planned_s = 0;
    };

    void forgive_own_stall();
    void stand_by(CoordinatorOutputs& out);
    void change_owner(CoordinatorOutputs& out);
    void take_over(CoordinatorOutputs& out);
    void inherit(const MachineState& last, CoordinatorOutputs& out);
    void go_on_with_inherited(CoordinatorOutputs& out);
    void cut_inherited(TakeoverDoubt doubt, CoordinatorOutputs& out);
    std::optional<TakeoverDoubt> doubt_of_inherited() const;
    void stand_down(CoordinatorOutputs& out);
    bool begins_slot();
    bool must_listen();
    void note_command(const Command& command, Reply reply);
    bool is_old(const Command& command) const;
    void hear(const CoordinatorInputs& inputs, CoordinatorOutputs& out);
    void take_command(const Command& command, CoordinatorOutputs& out);
    Reply answer(const Command& command, CoordinatorOutputs& out);
    Reply home(const Command& command, CoordinatorOutputs& out);
    Reply run(const Command& command, CoordinatorOutputs& out);
    Reply move_own(const Command& command, CoordinatorOutputs& out);
    Reply interrupt_own(const Command& command, Intent intent, CoordinatorOutputs& out);
    std::optional<Reply> refuse_own(const Command& command, std::size_t axis, std::int64_t steps) const;
    Reply interrupt(const Command& command, Intent intent, CoordinatorOutputs& out);
    Reply resume(const Command& command, CoordinatorOutputs& out);
    Reply reset(const Command& command, CoordinatorOutputs& out);
    Reply emergency(const Command& command, CoordinatorOutputs& out);
    Reply turn_overrides(const Command& command);
    Reply accepted(const Command& command) const;
    static Reply refused(const Command& command, FaultCode why, std::string text);
    std::optional<Reply> refuse_unless_ready(const Command& command) const;
    Reply refuse_in_fault(const Command& command) const;

    void watch_axes(CoordinatorOutputs& out);
    void advance(CoordinatorOutputs& out);
    void advance_homing(CoordinatorOutputs& out);
    void send_homing_group(CoordinatorOutputs& out);
    void begin_own(Job job, Ticks ticks, CoordinatorOutputs& out);
    void advance_own(CoordinatorOutputs& out);
    void halt_own();
    bool in_own_move() const { return job_ && job_->kind == JobKind::MoveOwn; }
    bool axes_move_alone() const { return in_own_move() || (job_ && job_->kind == JobKind::Home); }
    bool is_held() const { return phase_ == MachinePhase::Holding || phase_ == MachinePhase::Paused; }
    bool in_motion() const { return moving_ || axes_move_alone(); }
    double planned_seconds(std::size_t axis, std::int64_t steps, Ticks asked) const;
    void say_progress_of_own(MachineState& state) const;
    Subticks into_path() const;
    Subticks left_of_job() const;
    void note_progress();
    void say_progress(MachineState& state) const;
    void say_rests(MachineState& state) const;
    void time_legs();
    void estimate_legs(double slower);
    void begin_epoch(std::vector<PathMove> moves, Displacement along, std::vector<Position> at, PathPlace place,
                     CoordinatorOutputs& out);
    Epoch next_epoch();
    void begin_leg(CoordinatorOutputs& out);
    void end_leg(CoordinatorOutputs& out);
    void settle(const EpochEnd& end, CoordinatorOutputs& out);
    void give_up_epoch(CoordinatorOutputs& out);
    void interrupted(const EpochEnd& end, CoordinatorOutputs& out);
    void go_on(CoordinatorOutputs& out);
    void end_job(JobOutcome outcome, CoordinatorOutputs& out);
    void fail(FaultCode fault, std::size_t axis, CoordinatorOutputs& out);
    void enter(MachinePhase phase, CoordinatorOutputs& out);

    void order(std::size_t axis, AxisCommandKind kind);
    bool order_done(std::size_t axis) const;
    bool present(std::size_t axis) const { return views_[axis].present(now_slot_, machine_.timing); }
    std::optional<std::size_t> missing_axis() const;
    std::optional<std::size_t> axis_without_device() const;
    bool is_uncertain(std::size_t axis, Ticks limit) const;
    std::optional<Reply> refuse_uncertain_clocks(const Command& command) const;
    AxisCounts counts() const;
    MachineState state() const;

    static constexpr std::size_t kProgramsKept = 4;
    static constexpr int kMaxFruitless = 3;

    MachineConfig machine_;
    std::uint64_t config_hash_;
    BeginSteps begin_steps_;
    std::optional<OnTakeover> standby_;  // none: it does not stand by
    Ticks slot_;
    Ownership ownership_;
    ProgramPlanner planner_;
    EpochRunner runner_;
    std::vector<AxisView> views_;
    std::vector<std::optional<AxisCommand>> orders_;  // the newest to each axis, until done
    std::uint64_t order_sequence_ = 0;                // within its term

    MachinePhase phase_ = MachinePhase::Standby;
    FaultCode fault_ = FaultCode::None;
    std::size_t fault_axis_ = 0;
    Overrides overrides_;
    Intent intent_ = Intent::GoOn;
    bool moving_ = false;  // an epoch is in progress
    std::optional<Job> job_;
    std::optional<JobOutcome> outcome_;      // of the last job that ended
    Term job_begun_;                         // in which the last job was begun
    std::optional<MachineState> inherited_;  // of the owner before, who said this of a job that may be gone on with
    std::optional<Slot> interrupt_heard_;    // somebody asked another owner to hold or stop
    std::uint64_t jobs_ = 0;
    Epoch epoch_ = 0;            // the newest
    std::uint64_t cut_job_ = 0;  // the job that the takeover ended
    std::int32_t cut_line_ = 0;  // and where
    std::map<std::uint64_t, std::shared_ptr<const Program>> programs_;
    std::vector<std::uint64_t> program_order_;
    ClientMemory<Reply> replies_;  // the last one to each client

    Tick now_;
    Slot now_slot_ = 0;
    std::optional<Slot> state_slot_;
    std::vector<Command> commands_;  // heard, and not taken yet
    std::optional<Slot> woken_;      // from a stall in which another may have taken over
};

}  // namespace lockstep
