// Commands of clients to the job: carried out, or refused with the reason and the remedy.
#include <algorithm>
#include <memory>
#include <utility>

#include "core/check.hpp"
#include "core/coordinator/jobs/job_runner.hpp"
#include "core/coordinator/path/return_way.hpp"

namespace lockstep {
namespace {

/// `whole`: the program must have arrived whole.
std::expected<std::shared_ptr<const KnownProgram>, Refusal> program_of(const Command& command,
                                                                       const CoordinatorLoop& loop, bool whole) {
    auto program = loop.programs.find(command.program);
    if (const Reply* refusal = loop.programs.refusal_of(command.program)) {
        return refuse(refusal->fault, refusal->text);
    }
    if (!program) { return refuse(FaultCode::UnknownProgram, "the program has not arrived; send it again"); }
    if (whole && program->is_open()) {
        return refuse(FaultCode::UnknownProgram,
                      "the program has not arrived completely; this command needs the complete program");
    }
    return program;
}

/// Checks that the program begins where the axes stand and has not been cut.
CommandResult check_program(const KnownProgram& program, const ProgramPlanner& planner, const CoordinatorLoop& loop) {
    if (const auto& cut = program.cut()) { return refuse(cut->why, line_label(cut->line) + cut->text); }
    const auto fits = planner.check_start(program.head(), program.places(), loop.axes.counts());
    return fits ? CommandResult{} : refuse(fits.error().fault, fits.error().text);
}

/// Moves may be too slow for the LAI method.
CommandResult check_lai_moves(const KnownProgram& program, const ProgramPlanner& planner, const CoordinatorLoop& loop) {
    if (loop.machine.coordination != StepMethod::Lai) { return {}; }
    AxisCounts at = loop.axes.counts();
    for (std::uint32_t number = 0; !program.ends_before(number); ++number) {
        const Block& block = check_found(program.block(number), "a program that is planned as a whole is known");
        const auto move = planner.move_of(block, number, program.places(), at);
        if (move) { continue; }
        return refuse(move.error().fault, line_label(move.error().line) + move.error().text);
    }
    return {};
}

}  // namespace

void JobRunner::begin(JobKind kind, const Command& command, const AxisCounts& start_counts, CoordinatorLoop& loop) {
    const bool is_path = kind == JobKind::Run || kind == JobKind::Move;
    client_ = command.client;
    job_ = MachineJob{.number = count_.begin(loop.term),
                      .kind = kind,
                      .program_id = is_path ? std::optional(command.program) : std::nullopt,
                      .program = is_path || kind == JobKind::MoveOwn ? loop.programs.find(command.program) : nullptr};
    loop.out.jobs.push_back({.kind = JobEvent::Kind::Begun,
                             .job = job_->number,
                             .job_kind = kind,
                             .program = job_->program,
                             .program_id = job_->program_id,
                             .start_counts = start_counts});
}

void JobRunner::begin_in_pause(JobKind kind, std::shared_ptr<const KnownProgram> program,
                               const AxisCounts& start_counts, CoordinatorLoop& loop) {
    paused_ = std::exchange(
        job_, MachineJob{.number = count_.begin_in_pause(), .kind = kind, .program_id = {}, .program = program});
    loop.out.jobs.push_back({.kind = JobEvent::Kind::Begun,
                             .job = job_->number,
                             .job_kind = kind,
                             .program = std::move(program),
                             .start_counts = start_counts});
}

CommandResult JobRunner::home(const Command& command, CoordinatorLoop& loop) {
    if (auto ready = check_ready(loop, in_motion()); !ready) { return ready; }
    const AxisSet all = all_axes(loop.axes.size());
    if ((command.axes & ~all) != 0) { return refuse(FaultCode::BadProgram, "the machine does not have this axis"); }
    homing_ = HomingSequence(command.axes == 0 ? all : command.axes);
    intent_ = Intent::GoOn;
    begin(JobKind::Home, command, {}, loop);
    loop.enter(MachinePhase::Homing);
    home_next_group(loop);
    return {};
}

CommandResult JobRunner::run(const Command& command, CoordinatorLoop& loop) {
    if (auto ready = check_ready(loop, in_motion()); !ready) { return ready; }
    const auto program = program_of(command, loop, loop.machine.coordination == StepMethod::Lai);
    if (!program) { return std::unexpected(program.error()); }
    if (auto homed = check_homed(loop); !homed) { return homed; }
    if (auto clocks = check_clocks(loop); !clocks) { return clocks; }
    if (auto fits = check_program(**program, path_.planner(), loop); !fits) { return fits; }
    if (auto slow = check_lai_moves(**program, path_.planner(), loop); !slow) { return slow; }
    const AxisCounts start = loop.axes.counts();
    begin(command.kind == CommandKind::Move ? JobKind::Move : JobKind::Run, command, start, loop);
    path_.load(*job_, start);
    follow(path_.begin_leg(loop), loop);
    return {};
}

CommandResult JobRunner::move_own(const Command& command, CoordinatorLoop& loop) {
    if (auto ready = check_ready(loop, in_motion()); !ready) { return ready; }
    const auto program = program_of(command, loop, true);
    if (!program) { return std::unexpected(program.error()); }
    if (auto fits = check_program(**program, path_.planner(), loop); !fits) { return fits; }
    auto targets = OwnTargets::plan(**program, command.ticks, loop, begin_steps_);
    if (!targets) { return std::unexpected(targets.error()); }
    own_ = std::move(*targets);
    intent_ = Intent::GoOn;
    begin(JobKind::MoveOwn, command, own_.from(), loop);
    own_.order(loop);
    loop.enter(MachinePhase::Running);
    return {};
}

/// Several clients may jog different axes in one job. A release is accepted in any state of the machine.
CommandResult JobRunner::jog(const Command& command, CoordinatorLoop& loop) {
    if (!is_jogging() && command.jogs.empty()) { return {}; }
    const CommandResult ready = check_jog(loop);
    if (!ready && !command.jogs.empty()) { return ready; }
    if (auto pressed = jogs_.press(command, loop); !pressed || is_jogging()) { return pressed; }
    intent_ = Intent::GoOn;
    job_ ? begin_in_pause(JobKind::Jog, nullptr, {}, loop) : begin(JobKind::Jog, command, {}, loop);
    loop.enter(MachinePhase::Jogging);
    return {};
}

/// Axes may also be jogged in a pause.
CommandResult JobRunner::check_jog(const CoordinatorLoop& loop) const {
    return is_jogging() || is_paused(loop) ? check_present(loop) : check_ready(loop, in_motion());
}

CommandResult JobRunner::interrupt(Intent intent, CoordinatorLoop& loop) {
    if (axes_move_alone()) { return interrupt_alone(intent, loop); }
    if (loop.condition.is_held()) {
        if (intent == Intent::Hold) { return refuse(FaultCode::Held, "the job is already held or paused"); }
        end(JobOutcome::Stopped, loop);
        return {};
    }
    if (inherited_.exists()) {
        cut_inherited(TakeoverDoubt::Interrupted, loop);
        return {};
    }
    if (!path_.is_moving()) { return refuse(FaultCode::NothingToDo, "no motion is in progress"); }
    if (intent == Intent::Hold && intent_ > Intent::Hold) {
        return refuse(FaultCode::Busy, "the machine is already stopping, and the job ends with the stop");
    }
    intent_ = std::max(intent_, intent);
    path_.stop(loop.next_state);
    loop.enter(MachinePhase::Stopping);
    return {};
}

/// Homing and a jog cannot continue after a hold, so a hold ends them as a stop does.
CommandResult JobRunner::interrupt_alone(Intent intent, CoordinatorLoop& loop) {
    if (intent == Intent::Hold && job_->kind == JobKind::MoveOwn) {
        return refuse(FaultCode::Busy,
                      "moves of axes on their own cannot be held and resumed; stop them: lockstep stop");
    }
    intent_ = std::max(intent_, Intent::Stop);
    halt_alone(loop);
    loop.enter(MachinePhase::Stopping);
    return {};
}

/// The job goes on only from where it paused, because its next move begins there.
CommandResult JobRunner::check_place(const CoordinatorLoop& loop) const {
    if (loop.axes.counts() == path_.place()) { return {}; }
    const Program way = return_way(loop.machine, loop.axes.counts(), path_.place());
    return refuse(
        FaultCode::AwayFromPause,
        "axes were moved in the pause, but the job continues only from the place where it paused. Way back: " +
            text_of_way(way) + ". To let the machine return on this way and continue: lockstep resume --yes");
}

CommandResult JobRunner::begin_return(CoordinatorLoop& loop) {
    const AxisCounts here = loop.axes.counts();
    const Program way = return_way(loop.machine, here, path_.place());
    if (auto fits = path_.planner().check_start(way.head(), here); !fits) {
        return refuse(fits.error().fault, fits.error().text);
    }
    auto program = KnownProgram::begin(loop.machine, way.head(),
                                       std::make_unique<MemoryRows>(KnownProgram::row_width(way.head())));
    check(program.has_value(), "the way back names axes of the machine");
    if (const auto taken = program->append(way.blocks); !taken) {
        return refuse(taken.error().why, taken.error().text);
    }
    program->end();
    intent_ = Intent::GoOn;
    begin_in_pause(JobKind::Return, std::make_shared<KnownProgram>(*std::move(program)), here, loop);
    path_.load_return(*job_, here);
    follow(path_.begin_leg(loop), loop);
    return {};
}

CommandResult JobRunner::resume(const Command& command, CoordinatorLoop& loop) {
    if (loop.condition.phase() == MachinePhase::Fault) { return refuse_in_fault(loop.condition.fault()); }
    if (!loop.condition.is_held()) { return refuse(FaultCode::NothingToDo, "no job is held or paused"); }
    if (auto present = check_present(loop); !present) { return present; }
    if (auto clocks = check_clocks(loop); !clocks) { return clocks; }
    client_ = client_.value_or(command.client);
    const bool is_paused = loop.condition.phase() == MachinePhase::Paused;
    if (!is_paused) {
        follow(path_.go_on(loop), loop);
        return {};
    }
    if (auto placed = check_place(loop); !placed) { return command.returns ? begin_return(loop) : placed; }
    follow(path_.begin_leg(loop), loop);
    return {};
}

CommandResult JobRunner::turn(const Command& command, const CoordinatorLoop& loop) {
    if (loop.machine.coordination == StepMethod::Lai) {
        return refuse(FaultCode::NothingToDo, "coordination LAI does not support overrides; set coordination: RANADE");
    }
    for (const std::optional<int>& percent : {command.feed_percent, command.rapid_percent}) {
        if (!percent || Overrides::allows(*percent)) { continue; }
        return refuse(FaultCode::BadProgram,
                      "an override of " + std::to_string(*percent) + " % is out of range; it must be from " +
                          std::to_string(Overrides::kLeast) + " to " + std::to_string(Overrides::kMost) + " %");
    }
    Overrides overrides = path_.overrides();
    overrides.feed_percent = command.feed_percent.value_or(overrides.feed_percent);
    overrides.rapid_percent = command.rapid_percent.value_or(overrides.rapid_percent);
    path_.turn(overrides);
    return {};
}

}  // namespace lockstep
