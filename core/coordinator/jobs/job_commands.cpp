#include "core/coordinator/jobs/job_commands.hpp"

#include <memory>
#include <utility>

#include "core/check.hpp"
#include "core/coordinator/jobs/homing_job.hpp"
#include "core/coordinator/path/coordination.hpp"
#include "core/coordinator/path/return_way.hpp"
#include "core/kinematics/motors.hpp"
#include "core/protocol/names.hpp"

namespace lockstep::commands {
namespace {

/// `whole`: the program must have arrived whole.
std::expected<std::shared_ptr<const KnownProgram>, Refusal> program_of(const Command& command, const LoopView& loop,
                                                                       bool whole) {
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
CommandResult check_program(const KnownProgram& program, const ProgramPlanner& planner, const LoopView& loop) {
    if (const auto& cut = program.cut()) { return refuse(cut->why, line_label(cut->line) + cut->text); }
    const auto fits = planner.check_start(program.head(), program.places(), loop.counts());
    return fits ? CommandResult{} : refuse(fits.error().fault, fits.error().text);
}

/// Moves may be too slow for the LAI method.
CommandResult check_lai_moves(const KnownProgram& program, const ProgramPlanner& planner, const LoopView& loop) {
    if (!coordination_of(loop.machine).has_least_feed) { return {}; }
    AxisCounts at = loop.counts();
    for (std::uint32_t number = 0; !program.ends_before(number); ++number) {
        const Block& block = check_found(program.block(number), "a program that is planned as a whole is known");
        const auto move = planner.move_of(block, number, program.places(), at);
        if (move) { continue; }
        return refuse(move.error().fault, line_label(move.error().line) + move.error().text);
    }
    return {};
}

/// Checks that a job can begin: every axis is present, follows this coordinator and rests, and nothing else is in
/// progress.
CommandResult check_ready(const MachineActivity& activity, const LoopView& loop) {
    const MachinePhase phase = activity.phase();
    if (auto present = check_present(loop); !present) { return present; }
    const auto lacking = loop.axes.without_device();
    if (lacking && phase != MachinePhase::Fault) { return refuse_without_device(*lacking, loop); }
    if (phase == MachinePhase::Fault) { return refuse_in_fault(activity.fault().code); }
    if (activity.is_held()) { return refuse(FaultCode::Held, "a job is held or paused"); }
    if (activity.in_motion()) { return refuse(FaultCode::Busy, "the machine is " + std::string(name_of(phase))); }
    if (auto closed = check_holding_inputs(loop); !closed) { return closed; }
    if (phase == MachinePhase::Idle) { return {}; }
    return refuse(FaultCode::NotReady, "some axes do not follow the coordinator yet, or are not at rest");
}

/// The same for a job that may move any axis in any direction.
CommandResult check_ready_to_move(const MachineActivity& activity, const LoopView& loop) {
    const CommandResult ready = check_ready(activity, loop);
    return ready ? check_limits(loop) : ready;
}

/// A motor that moves several axes must home with all of them, because their places are known together or not at all.
CommandResult check_homes_alone(AxisSet axes, const LoopView& loop) {
    for (const MotorIndex m : loop.kinematics.motors_of_axes(axes)) {
        const MotorConfig& motor = loop.kinematics.motors()[m];
        const AxisSet moved = loop.kinematics.axes_of_motor(m);
        if (motor.moves_one_axis) { continue; }
        if (!axes.contains(moved)) {
            return refuse(FaultCode::BadProgram,
                          loop.label_of(m) + " moves several axes, which can only be homed together: name all of them");
        }
        if (row_of(motor.homing.way).searches) { continue; }  // the carriage of a delta, which has a switch
        for (const AxisIndex i : moved) {
            const AxisConfig& axis = loop.machine.axes[i];
            if (!row_of(axis.homing.way).stops_itself) { continue; }
            return refuse(FaultCode::BadProgram,
                          "the switch of axis " + axis.name +
                              " cannot stop motors of several devices; name an input "
                              "with use: HOME in its homing { input: ... }, or put the axis to its park_mm by hand, "
                              "and set homing { in_place: true } in its block");
        }
    }
    return {};
}

bool waits_for_input(const MachineActivity& activity) {
    const auto* const paused = activity.as<activity::Paused>();
    return paused != nullptr && paused->watch.has_value();
}

/// Axes may also be jogged in a pause.
CommandResult check_jog(const MachineActivity& activity, const LoopView& loop) {
    if (waits_for_input(activity)) {
        return refuse(FaultCode::Busy, "the job waits for an input and may go on at any time; hold it, then jog");
    }
    const bool may_join = activity.is_jogging() || activity.is<activity::Paused>();
    return may_join ? check_present(loop) : check_ready(activity, loop);
}

/// The job goes on only from where it paused, because its next move begins there. Motors rest on whole steps of their
/// own, so their places are compared.
CommandResult check_place(const AxisCounts& place, const LoopView& loop) {
    if (loop.kinematics.motors_at(place) == loop.axes.counts()) { return {}; }
    const Program way = return_way(loop.machine, loop.counts(), place);
    return refuse(
        FaultCode::AwayFromPause,
        "axes were moved in the pause, but the job continues only from the place where it paused. Way back: " +
            text_of_way(way));
}

CommandResult begin_return(const activity::Paused& pause, JobLifecycle& jobs, CoordinatorLoop& loop) {
    const AxisCounts here = loop.counts();
    const Program way = return_way(loop.machine, here, pause.task.from);
    if (auto fits = jobs.path().planner().check_start(way.head(), here); !fits) {
        return refuse(fits.error().fault, fits.error().text);
    }
    const auto known = known_program(way, loop.machine);
    if (!known) { return std::unexpected(known.error()); }
    PathTask task{.job = jobs.begin_in_pause(JobKind::Return, *known, here, loop), .from = here};
    const PathNext next = jobs.path().begin_leg(task, loop, loop.out.events);
    jobs.follow(std::move(task), next, pause, loop);
    return {};
}

/// New keys of a client whose jog is under way.
CommandResult press_on_path(const Command& command, activity::OnPath& path, JobLifecycle& jobs, PublishingLoop& loop) {
    PathJog& jog = *path.jog;
    if (!jog.is_of(command.client)) {
        return command.jogs.empty() ? CommandResult{} : refuse(FaultCode::Busy, "another client jogs axes");
    }
    if (path.intent == Intent::GoOn && jog.asks_the_same(command)) {
        jog.continue_by(command, loop);
        return {};
    }
    if (!command.jogs.empty()) {
        if (const auto possible = jog_program(command, loop); !possible) { return std::unexpected(possible.error()); }
    }
    jog.replace(command, loop);
    if (path.intent == Intent::GoOn) { brake_on_path(Intent::Stop, jobs, loop); }
    return {};
}

/// Homing and a jog cannot continue after a hold, so a hold ends them as a stop does. Where motors make up lost steps,
/// the job that would go on pauses.
CommandResult interrupt_alone(Intent intent, JobLifecycle& jobs, CoordinatorLoop& loop) {
    const bool corrects = is_correcting(jobs.activity());
    if (intent == Intent::Hold && jobs.activity().is<activity::OwnMoves>() && !corrects) {
        return refuse(FaultCode::Busy,
                      "moves of axes on their own cannot be held and resumed; they can only be stopped");
    }
    halt_axes(jobs.activity(), loop);
    jobs.activity().bring_to_rest(corrects ? intent : Intent::Stop, loop.out);
    return {};
}

/// A job that waits for an input waits for a person from now on.
void wait_for_person(PauseReason why, MachineActivity& activity, PublishingLoop& loop) {
    activity::Paused paused = check_found(activity.as<activity::Paused>(), "a job that waits for an input pauses");
    paused.why.reason = why;
    paused.watch.reset();
    activity.become(MachineEvent::Pauses, std::move(paused), loop.out);
}

CommandResult stop_at_once(JobLifecycle& jobs, CoordinatorLoop& loop) {
    loop.order_each(MotorSet::first(loop.axes.size()), AxisCommandKind::StopNow);
    jobs.fail({FaultCode::EmergencyStopped}, loop);
    return {};
}

/// By the number under which programs know the input, and a state stamped in slot `since` or later.
std::optional<bool> is_program_input_closed(int number, Slot since, const LoopView& loop) {
    const std::vector<InputConfig>& inputs = loop.machine.inputs;
    const InputConfig* const input = input_numbered(inputs, InputUse::Program, number);
    if (input == nullptr) { return std::nullopt; }
    return loop.axes.is_closed(static_cast<std::size_t>(input - inputs.data()), since);
}

}  // namespace

std::expected<std::shared_ptr<const KnownProgram>, Refusal> known_program(const Program& own,
                                                                          const MachineConfig& machine) {
    auto program =
        KnownProgram::begin(machine, own.head(), std::make_unique<MemoryRows>(KnownProgram::row_width(own.head())));
    check(program.has_value(), "a program of the coordinator names axes of the machine");
    if (const auto taken = program->append(own.blocks); !taken) {
        return refuse(taken.error().why, taken.error().text);
    }
    program->end();
    return std::make_shared<const KnownProgram>(*std::move(program));
}

CommandResult home(const Command& command, JobLifecycle& jobs, CoordinatorLoop& loop) {
    if (auto ready = check_ready_to_move(jobs.activity(), loop); !ready) { return ready; }
    const AxisSet all = AxisSet::first(loop.machine.axes.size());
    if (!all.contains(command.axes)) { return refuse(FaultCode::BadProgram, "the machine does not have this axis"); }
    const AxisSet axes = command.axes.empty() ? all : command.axes;
    if (auto alone = check_homes_alone(axes, loop); !alone) { return alone; }
    const bool is_by_touch = !axes_homed_by_touch(axes, loop.machine).empty();
    if (auto clocks = check_clocks(loop); is_by_touch && !clocks) { return clocks; }
    activity::Homing homing{{},
                            jobs.begin(JobKind::Home, command, nullptr, {}, loop),
                            HomingSequence(axes),
                            SkewWatch(loop.machine, loop.kinematics)};
    (void)home_next_group(homing, loop);
    jobs.activity().become(MachineEvent::HomingBegins, std::move(homing), loop.out);
    return {};
}

CommandResult run(const Command& command, JobLifecycle& jobs, CoordinatorLoop& loop) {
    if (auto ready = check_ready_to_move(jobs.activity(), loop); !ready) { return ready; }
    const auto program = program_of(command, loop, coordination_of(loop.machine).plans_whole);
    if (!program) { return std::unexpected(program.error()); }
    if (auto homed = check_homed(loop); !homed) { return homed; }
    if (auto square = check_square(loop); !square) { return square; }
    if (auto clocks = check_clocks(loop); !clocks) { return clocks; }
    PathRunner& path = jobs.path();
    if (auto fits = check_program(**program, path.planner(), loop); !fits) { return fits; }
    if (auto slow = check_lai_moves(**program, path.planner(), loop); !slow) { return slow; }
    const AxisCounts start = path.planner().start_of((*program)->head(), (*program)->places(), loop.counts());
    const JobKind kind = command.kind == CommandKind::Move ? JobKind::Move : JobKind::Run;
    PathTask task{.job = jobs.begin(kind, command, *program, start, loop), .from = start};
    path.events().begin();
    jobs.go_on({std::move(task), {}, {}}, loop);
    return {};
}

CommandResult move_own(const Command& command, BeginSteps begin_steps, JobLifecycle& jobs, CoordinatorLoop& loop) {
    if (auto ready = check_ready_to_move(jobs.activity(), loop); !ready) { return ready; }
    const auto program = program_of(command, loop, true);
    if (!program) { return std::unexpected(program.error()); }
    if (auto fits = check_program(**program, jobs.path().planner(), loop); !fits) { return fits; }
    auto targets = OwnTargets::plan(**program, command.ticks, loop, begin_steps);
    if (!targets) { return std::unexpected(targets.error()); }
    targets->order(loop.orders, loop.term);
    activity::OwnMoves moves{{}, jobs.begin(JobKind::MoveOwn, command, *program, targets->from(), loop), *targets};
    jobs.activity().become(MachineEvent::OwnMovesBegin, std::move(moves), loop.out);
    return {};
}

CommandResult begin_path_jog(const Command& command, Tick renewed, JobLifecycle& jobs, CoordinatorLoop& loop) {
    if (auto closed = check_holding_inputs(loop); !closed) { return closed; }
    if (auto homed = check_homed(loop); !homed) { return homed; }
    if (auto square = check_square(loop); !square) { return square; }
    if (auto clocks = check_clocks(loop); !clocks) { return clocks; }
    const auto program = jog_program(command, loop);
    if (!program) { return std::unexpected(program.error()); }
    const AxisCounts here = loop.counts();
    if (auto fits = jobs.path().planner().check_start(program->head(), here); !fits) {
        return refuse(fits.error().fault, fits.error().text);
    }
    const auto known = known_program(*program, loop.machine);
    if (!known) { return std::unexpected(known.error()); }
    const auto* const paused = jobs.activity().as<activity::Paused>();
    std::optional<activity::Paused> pause = paused != nullptr ? std::optional(*paused) : std::nullopt;
    PathTask task{.job = pause ? jobs.begin_in_pause(JobKind::Jog, *known, here, loop)
                               : jobs.begin(JobKind::Jog, command, *known, here, loop),
                  .from = here};
    const PathNext next = jobs.path().begin_leg(task, loop, loop.out.events);
    if (!std::holds_alternative<EpochBegun>(next)) {  // less than a step is left
        jobs.follow(std::move(task), next, std::move(pause), loop);
        return {};
    }
    PathJog path_jog(command, renewed, loop);
    activity::OnPath moving{{}, std::move(task), std::move(pause), std::move(path_jog)};
    jobs.activity().become(MachineEvent::JogBegins, std::move(moving), loop.out);
    return {};
}

CommandResult jog(const Command& command, JobLifecycle& jobs, CoordinatorLoop& loop) {
    MachineActivity& activity = jobs.activity();
    if (auto closed = check_holding_inputs(loop); !closed && !command.jogs.empty()) { return closed; }
    if (auto away = check_jogs_at_limits(command.jogs, loop); !away) { return away; }
    if (auto* const path = activity.as<activity::OnPath>(); path != nullptr && path->jog) {
        return press_on_path(command, *path, jobs, loop);
    }
    if (!activity.is_jogging() && command.jogs.empty()) { return {}; }
    const CommandResult ready = check_jog(activity, loop);
    if (!ready && !command.jogs.empty()) { return ready; }
    if (activity.is_jogging()) { return activity.as<activity::Jogging>()->jogs.press(command, loop); }
    if (needs_path(command, loop.kinematics)) { return begin_path_jog(command, loop.now, jobs, loop); }
    Jogs jogs(loop.machine);
    if (auto pressed = jogs.press(command, loop); !pressed) { return pressed; }
    const auto* const paused = activity.as<activity::Paused>();
    const std::optional<activity::Paused> pause = paused != nullptr ? std::optional(*paused) : std::nullopt;
    activity::Jogging jogging{{},
                              pause ? jobs.begin_in_pause(JobKind::Jog, nullptr, {}, loop)
                                    : jobs.begin(JobKind::Jog, command, nullptr, {}, loop),
                              std::move(jogs),
                              pause};
    activity.become(MachineEvent::JogBegins, std::move(jogging), loop.out);
    return {};
}

bool renew_jog(const Command& command, JobLifecycle& jobs, const LoopView& loop) {
    auto* const path = jobs.activity().as<activity::OnPath>();
    if (path != nullptr && path->jog) { return path->jog->renew(command, loop); }
    auto* const jogging = jobs.activity().as<activity::Jogging>();
    return jogging != nullptr && jogging->jogs.renew(command, loop);
}

CommandResult interrupt(Intent intent, JobLifecycle& jobs, CoordinatorLoop& loop) {
    MachineActivity& activity = jobs.activity();
    if (waits_for_input(activity) && intent == Intent::Hold) {
        wait_for_person(PauseReason::Hold, jobs.activity(), loop);
        return {};
    }
    if (activity.is_held()) {
        if (intent == Intent::Hold) { return refuse(FaultCode::Held, "the job is already held or paused"); }
        jobs.end(JobOutcome::Stopped, loop);
        return {};
    }
    if (activity.inherited() != nullptr) {
        jobs.cut_inherited(TakeoverDoubt::Interrupted, loop);
        return {};
    }
    if (!activity.in_motion()) { return refuse(FaultCode::NothingToDo, "no motion is in progress"); }
    auto* const path = activity.as<activity::OnPath>();
    if (path == nullptr) { return interrupt_alone(intent, jobs, loop); }
    if (path->jog) { path->jog->finish(); }
    if (path->jog || path->homing) { intent = Intent::Stop; }
    if (intent == Intent::Hold && activity.intent() > Intent::Hold) {
        return refuse(FaultCode::Busy, "the machine is already stopping, and the job ends with the stop");
    }
    brake_on_path(intent, jobs, loop);
    return {};
}

CommandResult resume(const Command& command, JobLifecycle& jobs, CoordinatorLoop& loop) {
    MachineActivity& activity = jobs.activity();
    if (activity.is<activity::InFault>()) { return refuse_in_fault(activity.fault().code); }
    if (!activity.is_held()) { return refuse(FaultCode::NothingToDo, "no job is held or paused"); }
    if (auto present = check_present(loop); !present) { return present; }
    if (auto closed = check_holding_inputs(loop); !closed) { return closed; }
    if (auto away = check_limits(loop); !away) { return away; }
    if (auto clocks = check_clocks(loop); !clocks) { return clocks; }
    MachineJob& job = *activity.job();
    job.client = job.client.value_or(command.client);
    if (const auto* const held = activity.as<activity::Holding>()) {
        activity::Holding from = *held;
        jobs.path().begin_epoch(from.task, from.place, from.positions, loop);
        jobs.follow(std::move(from.task), EpochBegun{}, {}, loop);
        return {};
    }
    activity::Paused pause = *activity.as<activity::Paused>();
    if (auto placed = check_place(pause.task.from, loop); !placed) {
        return command.returns ? begin_return(pause, jobs, loop) : placed;
    }
    pause.why.wait ? jobs.pause(std::move(pause), loop) : jobs.go_on(std::move(pause), loop);
    return {};
}

CommandResult set_overrides(const Command& command, JobLifecycle& jobs, const LoopView& loop) {
    if (!coordination_of(loop.machine).takes_overrides) {
        return refuse(FaultCode::NothingToDo, "coordination LAI does not support overrides; set coordination: RANADE");
    }
    for (const std::optional<int>& percent : {command.feed_percent, command.rapid_percent}) {
        if (!percent || Overrides::allows(*percent)) { continue; }
        return refuse(FaultCode::BadProgram,
                      "an override of " + std::to_string(*percent) + " % is out of range; it must be from " +
                          std::to_string(Overrides::kLeast) + " to " + std::to_string(Overrides::kMost) + " %");
    }
    Overrides overrides = jobs.path().overrides();
    overrides.feed_percent = command.feed_percent.value_or(overrides.feed_percent);
    overrides.rapid_percent = command.rapid_percent.value_or(overrides.rapid_percent);
    jobs.path().set_overrides(overrides);
    return {};
}

CommandResult reset(JobLifecycle& jobs, CoordinatorLoop& loop) {
    if (auto released = check_emergency_stops(loop); !released) { return released; }
    MachineActivity& activity = jobs.activity();
    if (activity.in_motion()) { return refuse(FaultCode::Busy, "the machine is in motion"); }
    if (activity.is_held()) { jobs.end(JobOutcome::Stopped, loop); }
    jobs.cut_inherited(TakeoverDoubt::Interrupted, loop);
    activity.become(MachineEvent::Reset, activity::Waiting{}, loop.out);
    loop.order_each(MotorSet::first(loop.axes.size()), AxisCommandKind::Reset);
    return {};
}

CommandResult carry_out(const Command& command, BeginSteps begin_steps, JobLifecycle& jobs, CoordinatorLoop& loop) {
    switch (command.kind) {
        case CommandKind::Home: return home(command, jobs, loop);
        case CommandKind::Move:
        case CommandKind::Run: return run(command, jobs, loop);
        case CommandKind::Hold: return interrupt(Intent::Hold, jobs, loop);
        case CommandKind::Stop: return interrupt(Intent::Stop, jobs, loop);
        case CommandKind::Resume: return resume(command, jobs, loop);
        case CommandKind::Reset: return reset(jobs, loop);
        case CommandKind::EmergencyStop: return stop_at_once(jobs, loop);
        case CommandKind::MoveOwn: return move_own(command, begin_steps, jobs, loop);
        case CommandKind::Override: return set_overrides(command, jobs, loop);
        case CommandKind::Jog: return jog(command, jobs, loop);
        case CommandKind::TakeLease:
        case CommandKind::GiveLease: break;  // answered before
    }
    return refuse(FaultCode::NothingToDo, "unknown command");
}

void go_on_at_input(JobLifecycle& jobs, CoordinatorLoop& loop) {
    if (!waits_for_input(jobs.activity())) { return; }
    activity::Paused& paused = *jobs.activity().as<activity::Paused>();
    const auto is_closed = is_program_input_closed(paused.why.wait->input, paused.watch->since(), loop);
    const bool can_go_on = check_present(loop) && check_clocks(loop);
    switch (paused.watch->look(can_go_on ? is_closed : std::nullopt, loop.now)) {
        case InputWatch::Result::Waits: return;
        case InputWatch::Result::TimedOut: return wait_for_person(PauseReason::InputTimeout, jobs.activity(), loop);
        case InputWatch::Result::IsMet: return jobs.go_on(std::move(paused), loop);
    }
}

void hold_for_inputs(JobLifecycle& jobs, CoordinatorLoop& loop) {
    const auto input = holding_input(loop.axes);
    if (!input) { return; }
    jobs.cut_inherited(TakeoverDoubt::Interrupted, loop);
    const MachineActivity& activity = jobs.activity();
    const bool goes_on = activity.in_motion() && activity.intent() == Intent::GoOn;
    if (!goes_on && !waits_for_input(activity)) { return; }
    loop.notice({CoordinatorNotice::Kind::HeldByInput, FaultCode::None, *input});
    const bool cannot_be_held = activity.is<activity::OwnMoves>() && !is_correcting(activity);
    (void)interrupt(cannot_be_held ? Intent::Stop : Intent::Hold, jobs, loop);
}

void rest_at_touch(std::size_t input, JobLifecycle& jobs, CoordinatorLoop& loop) {
    const InputConfig& config = loop.machine.inputs[input];
    loop.notice({CoordinatorNotice::Kind::TouchInMotion, FaultCode::None, input});
    if (config.at_touch_in_motion == TouchInMotion::Fault) {
        const auto motor = motor_named(loop.machine, config.motor);
        return jobs.fail({FaultCode::TouchInMotion, motor.value_or(MotorIndex{})}, loop);
    }
    const bool can_hold = jobs.activity().is<activity::OnPath>();
    (void)interrupt(can_hold ? Intent::Hold : Intent::Stop, jobs, loop);
}

void lose_client(Identity client, JobLifecycle& jobs, CoordinatorLoop& loop) {
    MachineActivity& activity = jobs.activity();
    const MachineJob* const job = activity.job();
    if (job == nullptr || job->client != client) { return; }
    leave_to_itself(client, jobs);
    const bool is_of_job = activity.is<activity::OnPath>() || is_correcting(activity);
    const bool goes_on = is_of_job && activity.intent() == Intent::GoOn;
    if (!goes_on && !waits_for_input(activity)) { return; }
    const bool is_held = loop.machine.unattended_job == UnattendedJob::IsHeld;
    const std::uint64_t number = job->number;
    if (is_held) { (void)interrupt(Intent::Hold, jobs, loop); }
    loop.notice({is_held ? CoordinatorNotice::Kind::UnattendedHeld : CoordinatorNotice::Kind::UnattendedRunsOn,
                 FaultCode::None, number});
}

void leave_to_itself(Identity client, JobLifecycle& jobs) {
    MachineJob* const job = jobs.activity().job();
    if (job != nullptr && job->client == client) { job->client.reset(); }
}

}  // namespace lockstep::commands
