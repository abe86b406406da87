#include "core/coordinator/jobs/path_runner.hpp"

#include <algorithm>
#include <cmath>
#include <utility>

#include "core/check.hpp"
#include "core/coordinator/path/program_frames.hpp"
#include "core/kinematics/motors.hpp"
#include "core/outputs/output_levels.hpp"

namespace lockstep {
namespace {

/// Returns the pause that the program asks for after the leg, if it does.
std::optional<Pause> pass_leg(PathTask& task, const LegEnd& end) {
    task.next = end.kind == LegEnd::Kind::Program ? end.block : end.block + 1;
    task.from = end.to;
    task.probe = end.kind == LegEnd::Kind::Probe ? std::optional(end.probe) : std::nullopt;
    return end.kind == LegEnd::Kind::Pause ? std::optional(end.pause) : std::nullopt;
}

/// Returns the end of the leg that begins with the next block if nothing moves in it. Returns nullopt if something
/// moves, or if a bounded search does not find its end.
std::optional<LegEnd> end_of_empty_leg(const PathTask& task, const ProgramPlanner& planner) {
    const KnownProgram& program = *task.job.program;
    LegEnd end{.block = task.next, .to = task.from};
    for (; end.block < task.next + ProgramFrames::kBlocksAtOnce; ++end.block) {
        if (program.ends_before(end.block)) { return end; }
        const Block* const block = program.block(end.block);
        if (block == nullptr) { return std::nullopt; }
        note_end(*block, end);
        if (ends_leg(*block)) { return end; }
        if (planner.moves(*block, program.places(), end.to)) { return std::nullopt; }
    }
    return std::nullopt;
}

/// Returns an epoch greater than `newest` and any of this term that an axis has accepted from any sender.
Epoch epoch_after(Epoch newest, const LoopView& loop) {
    newest = std::max(newest, first_epoch(loop.term));
    for (const AxisView& view : loop.axes.views()) {
        if (view.state && is_epoch_of(view.state->epoch, loop.term)) { newest = std::max(newest, view.state->epoch); }
    }
    return newest + 1;
}

ProgramEvents::Of of(const PathTask& task, const EpochRunner& runner) {
    return {task.job.number, task.has_moved ? runner.epoch() : 0};
}

/// The devices know how many pulses they made before they came to rest.
void note_pulses(ProgramEvents& events, const LoopView& loop) {
    for (const OutputConfig& output : loop.machine.outputs) {
        if (!output.makes_pulses() || !is_active(output, events.devices())) { continue; }
        const auto motor = motor_named(loop.machine, output.motor);
        if (motor && loop.axes.state(*motor)) { events.note_pulses(loop.axes.state(*motor)->pulses_left); }
    }
}

/// Makes the frames of the next leg in the memory of the last leg, if its source can do that.
void load_leg(const PathTask& task, const ProgramPlanner& planner, EpochRunner& runner) {
    const auto& program = task.job.program;
    const OwnedSource& source = runner.source();
    const bool has_begun = source && source->begin(program, program->places(), task.next, task.from);
    if (!has_begun) { runner.load(planner.frames(program, task.next, task.from)); }
}

}  // namespace

/// Publishes the events of a leg in which nothing moves, or those at the end of a leg that another coordinator has run.
void PathRunner::pass_events(const PathTask& task, const LegEnd& end, const LoopView& loop,
                             std::vector<PublishedEvent>& out) {
    for (std::uint32_t k = std::max(task.next, events_.from()); k < end.block; ++k) {
        const Block* const block = task.job.program->block(k);
        if (block == nullptr) { break; }
        const auto* event = std::get_if<ProgramEvent>(&block->action);
        if (event != nullptr) { events_.pass(PathEvent{k, block->line, *event}, of(task, runner_), loop, out); }
    }
}

std::optional<Probed> PathRunner::end_probe_at_begin(const PathTask& task, const LoopView& loop) {
    if (!task.probe) { return std::nullopt; }
    const KnownProgram& program = *task.job.program;
    const Block* const move = program.block(task.next);
    const TouchInputs inputs = planner_.touch_inputs(*task.probe, move, program.places(), task.from);
    check(!inputs.empty(), "the inputs of a probe are checked when its program arrives");
    return probing_.end_at_begin(task, inputs, !end_of_empty_leg(task, planner_), loop);
}

PathNext PathRunner::begin_leg(PathTask& task, const LoopView& loop, std::vector<PublishedEvent>& out) {
    while (!task.job.program->ends_before(task.next)) {
        const auto empty = end_of_empty_leg(task, planner_);
        if (!empty) { break; }
        pass_events(task, *empty, loop, out);
        if (task.probe) { break; }
        if (const auto pause = pass_leg(task, *empty)) { return *pause; }
    }
    if (const auto end = end_probe_at_begin(task, loop)) { return *end; }
    if (task.job.program->ends_before(task.next)) { return ProgramDone{}; }
    load_leg(task, planner_, runner_);
    begin_epoch(task, {task.next, {}}, {}, loop);
    return EpochBegun{};
}

PathNext PathRunner::end_leg(PathTask& task, const LoopView& loop, std::vector<PublishedEvent>& out) {
    if (const auto pause = pass_leg(task, runner_.source()->end())) { return *pause; }
    return begin_leg(task, loop, out);
}

Pause PathRunner::hold_behind_leg(PathTask& task) const {
    return pass_leg(task, runner_.source()->end()).value_or(Pause{.reason = PauseReason::Hold});
}

PathNext PathRunner::continue_rest(PathTask& task, const JobRest& rest, std::uint32_t events_from, const LoopView& loop,
                                   std::vector<PublishedEvent>& out) {
    events_.begin(events_from);
    if (rest.done) {
        pass_events(task, *rest.done, loop, out);
        if (const auto pause = pass_leg(task, *rest.done)) { return *pause; }
        return begin_leg(task, loop, out);
    }
    load_leg(task, planner_, runner_);
    runner_.source()->begin_events_from(events_from);
    begin_epoch(task, rest.place, rest.positions, loop);
    return EpochBegun{};
}

void PathRunner::begin_epoch(PathTask& task, const PathPlace& place, MotorPositions at, const LoopView& loop) {
    for (MotorIndex m{at.size()}; m < loop.axes.size(); ++m) {
        at.append(Position::steps(loop.axes.state(m)->position.count()));
    }
    task.has_moved = true;
    SwitchedBy switched{events_.devices(), events_.from()};
    const JobKind kind = task.job.kind;
    const bool is_aside = kind == JobKind::Jog || kind == JobKind::Return || kind == JobKind::Home;
    if (is_aside) { switched.devices.pulses = {}; }
    const TouchInputs touch = task.probe ? probing_.awaited() : TouchInputs{};
    probing_.begin_epoch(at, loop);
    runner_.begin(epoch_after(runner_.epoch(), loop), place, at, overrides_, switched, touch);
}

void PathRunner::note_start(const PathTask& task, const LoopView& loop, CoordinatorOutputs& out) {
    const EpochRunner::Begin& begin = runner_.begun();
    for (const PathEvent& event : runner_.source()->events_before(begin.place.block)) {
        events_.pass(event, of(task, runner_), loop, out.events);
    }
    out.notices.push_back({CoordinatorNotice::Kind::EpochBegun, FaultCode::None, runner_.epoch()});
    out.jobs.push_back({.kind = JobEvent::Kind::EpochBegun,
                        .job = task.job.number,
                        .job_kind = task.job.kind,
                        .epoch = runner_.epoch(),
                        .start = *runner_.made().start(),
                        .place = begin.place,
                        .overrides = begin.overrides,
                        .start_counts = {},
                        .plays = loop.plays()});
}

/// Reports the epoch's start as soon as its first frame can be made.
std::optional<EpochEnd> PathRunner::advance(const PathTask& task, const LoopView& loop, CoordinatorOutputs& out) {
    const bool had_started = runner_.made().start().has_value();
    out.frames = runner_.send(loop.slot, loop.axes.views());
    for (Frame& frame : out.frames) { frame.term = loop.term; }
    if (!had_started && runner_.made().start()) { note_start(task, loop, out); }
    for (const EpochRunner::Happened& event : runner_.take_events(loop.now, loop.axes.views())) {
        events_.happen(event.event, event.tick, of(task, runner_), loop, out.events);
    }
    if (const auto change = runner_.overrides().take_change()) {
        out.jobs.push_back({.kind = JobEvent::Kind::Overridden,
                            .job = task.job.number,
                            .job_kind = task.job.kind,
                            .epoch = runner_.epoch(),
                            .overrides = change->overrides,
                            .behind = change->behind});
    }
    auto end = runner_.evaluate(loop.slot, loop.axes.views());
    if (!end || probing_.may_touch_yet(task, *end, runner_, loop)) { return std::nullopt; }
    Probing::check_place(*end, runner_, loop);
    return end;
}

/// The axes have passed the places of all events before the block in which they rest.
void PathRunner::end_epoch(PathTask& task, const EpochEnd& end, const LoopView& loop,
                           std::vector<PublishedEvent>& out) {
    const bool is_whole = end.kind == EpochEnd::Kind::Complete;
    if (end.rests_on_path()) {
        const std::uint32_t before = is_whole ? runner_.source()->end().block : end.place.block;
        for (const PathEvent& event : runner_.source()->events_before(before)) {
            events_.pass(event, of(task, runner_), loop, out);
        }
        if (end.has_pulses) { note_pulses(events_, loop); }
    }
    task.progress.end_path(subticks(runner_.made().ticks_of(end.ran)));
}

}  // namespace lockstep
