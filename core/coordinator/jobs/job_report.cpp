#include "core/coordinator/jobs/job_report.hpp"

#include <algorithm>

#include "core/coordinator/path/coordination.hpp"

namespace lockstep {
namespace {

/// Reuses the memory of the last state's pause.
void report_pause(const activity::Paused* pause, MachineState& state, const LoopView& loop) {
    if (pause == nullptr) { return state.pause.reset(); }
    if (!state.pause) { state.pause.emplace(); }
    state.pause->why = pause->why;
    state.pause->place = pause->task.from;
    const Ticks left = pause->watch ? pause->watch->left(loop.now) : Ticks{};
    state.pause->wait_left_s = static_cast<double>(left.value) / loop.machine.ticks_per_second();
}

void report_epoch(const PathRunner& path, MachineState& state) {
    const EpochRunner& runner = path.runner();
    state.epoch = runner.epoch();
    state.sent = runner.made().newest();
    state.veto = runner.veto();
    state.overrides = path.overrides();
    state.devices = path.events().devices();
    state.events_from = path.events().from();
    state.probe = path.probing().result();
}

void report_held(const PathTask& task, const PathPlace& place, const PathRunner& path, MachineState& state) {
    state.line = path.runner().source()->line_of(place.block);
    state.remaining_s = path.seconds_left(place);
    state.progress = task.progress.share();
}

double seconds_after_pause(const PathTask& task, const PathRunner& path) {
    return task.job.program->seconds_from({task.next, {}}) / path.overrides().feed();
}

/// The program may have paused before anything moved, so that no leg is loaded.
void report_paused(const PathTask& task, const PathRunner& path, MachineState& state) {
    const Block* const pause = task.next > 0 ? task.job.program->block(task.next - 1) : nullptr;
    if (pause != nullptr) { state.line = pause->line; }
    state.remaining_s = seconds_after_pause(task, path);
    state.progress = task.progress.share();
}

void report_own(const activity::OwnMoves& moves, const PathRunner& path, MachineState& state, const LoopView& loop) {
    state.progress = moves.targets.progress(loop.axes);
    state.remaining_s = moves.targets.remaining_s(loop.now, loop.machine);
    if (!moves.pause) { return; }
    state.progress = moves.pause->task.progress.share();
    state.remaining_s += seconds_after_pause(moves.pause->task, path);
}

/// Reports where each frame would rest, for another coordinator that may continue the task. If a block is planned in
/// several parts, its place on the program does not say where it was left.
void report_rests(const PathTask& task, const EpochRunner& runner, MachineState& state, const LoopView& loop) {
    if (!coordination_of(loop.machine).tells_places) { return; }
    FrameNumber oldest = runner.made().newest();
    for (const AxisView& view : loop.axes.views()) {
        const bool follows = view.state && view.state->epoch == runner.epoch();
        oldest = std::min(oldest, follows ? view.state->ran : 0);
    }
    state.job_kind = task.job.kind;
    state.program = task.job.program_id;
    state.leg_from = task.from;
    runner.made().list_rests(oldest, state.rests);
}

void report_on_path(const activity::OnPath& moving, const PathRunner& path, MachineState& state, const LoopView& loop) {
    report_held(moving.task, path.runner().made().place_at(state.tick), path, state);
    state.lacks_blocks = path.runner().source()->lacks_blocks();
    if (moving.pause) {
        state.remaining_s += seconds_after_pause(moving.pause->task, path);
        state.progress = moving.pause->task.progress.share();
    } else if (moving.intent == Intent::GoOn && !moving.jog && !moving.homing &&
               !moving.task.probe) {  // others cannot continue these
        report_rests(moving.task, path.runner(), state, loop);
    }
}

std::optional<HomedByTouch> homed_by_touch(const MachineActivity& activity) {
    const auto* homing = activity.as<activity::Homing>();
    const auto* const moving = activity.as<activity::OnPath>();
    if (moving != nullptr && moving->homing) { homing = &*moving->homing; }
    if (homing == nullptr || !homing->touch) { return std::nullopt; }
    return HomedByTouch{static_cast<std::uint32_t>(homing->touch->axis()), homing->touch->stage()};
}

}  // namespace

void report_job(const JobLifecycle& jobs, MachineState& state, const LoopView& loop) {
    const MachineActivity& activity = jobs.activity();
    const JobCount& count = jobs.count();
    state.job = count.number();
    state.outcome = activity.has_job() ? std::nullopt : count.outcome();
    state.job_begun = count.begun_in();
    state.line = count.line();
    state.job_fault = count.fault();
    report_epoch(jobs.path(), state);
    const auto* const paused = activity.as<activity::Paused>();
    const auto* const around = is_correcting(activity) ? nullptr : activity.pause();  // such a job goes on by itself
    report_pause(paused != nullptr ? paused : around, state, loop);
    if (const MachineState* const inherited = activity.inherited()) {
        state.line = inherited->line;
        state.progress = inherited->progress;
    }
    if (const auto* const moves = activity.as<activity::OwnMoves>()) { report_own(*moves, jobs.path(), state, loop); }
    if (const auto* const held = activity.as<activity::Holding>()) {
        report_held(held->task, held->place, jobs.path(), state);
    }
    if (paused != nullptr) { report_paused(paused->task, jobs.path(), state); }
    if (const auto* const moving = activity.as<activity::OnPath>()) {
        report_on_path(*moving, jobs.path(), state, loop);
    }
    state.homing = homed_by_touch(activity);
}

}  // namespace lockstep
