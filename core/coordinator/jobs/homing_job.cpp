#include "core/coordinator/jobs/homing_job.hpp"

#include <utility>

#include "core/check.hpp"
#include "core/coordinator/jobs/job_commands.hpp"
#include "core/coordinator/jobs/job_events.hpp"

namespace lockstep {
namespace {

bool is_of_homing(AxisCommandKind kind) {
    return kind == AxisCommandKind::Home || kind == AxisCommandKind::Approach || kind == AxisCommandKind::Assume ||
           kind == AxisCommandKind::TakePlace;
}

/// Where axes are assumed to be when homing by touch begins: those without a switch at their parks, the others in the
/// middle of their travels.
AxisCounts first_places(MotorSet motors, const LoopView& loop) {
    AxisCounts places = loop.counts();
    for (const AxisIndex i : axis_indices(places.size())) {
        const AxisConfig& axis = loop.machine.axes[i];
        if ((loop.kinematics.motors_of_axes({i}) & motors).empty()) { continue; }
        const double middle_mm = (axis.position_min_mm + axis.position_max_mm) / 2;
        places[i] = to_steps(axis, row_of(axis.homing.way).searches ? middle_mm : axis.homing.park_mm);
    }
    return places;
}

/// All motors of axes that have one that is not homed, or at no place at which the axis rests: a path that stopped
/// early may leave motors with different steps so. No path could begin there.
MotorSet motors_without_places(const LoopView& loop) {
    const MotorCounts counts = loop.axes.counts();
    const MotorCounts agreeing = loop.kinematics.motors_at(loop.counts());
    MotorSet motors;
    for (const AxisIndex i : axis_indices(loop.machine.axes.size())) {
        const MotorSet of_axis = loop.kinematics.motors_of_axes({i});
        for (const MotorIndex m : of_axis) {
            const auto& state = loop.axes.state(m);
            const bool has_place = state && state->homed && counts[m] == agreeing[m];
            if (state && !has_place) { motors |= of_axis; }
        }
    }
    return motors;
}

/// Every motor takes part in each frame, so all that are not homed assume places.
void assume_places(const activity::Homing& homing, CoordinatorLoop& loop) {
    const MotorSet motors = motors_homed_by_touch(homing.sequence.axes(), loop) | motors_without_places(loop);
    const MotorCounts places = loop.kinematics.motors_at(first_places(motors, loop));
    for (const MotorIndex m : motors) { loop.order(m, AxisCommandKind::Assume).target_steps = places[m]; }
}

void assume(AxisIndex axis, const MotorCounts& places, CoordinatorLoop& loop) {
    for (const MotorIndex m : loop.kinematics.motors_of_axes({axis})) {
        loop.order(m, AxisCommandKind::Assume).target_steps = places[m];
    }
}

/// The axes are truly where their motors assume to be.
void take_places(const activity::Homing& homing, CoordinatorLoop& loop) {
    for (const MotorIndex m : motors_homed_by_touch(homing.sequence.axes(), loop)) {
        const std::int64_t count = loop.axes.state(m)->position.count();
        loop.order(m, AxisCommandKind::TakePlace).target_steps = count;
    }
}

/// An axis that has homed parks to the nearest step. Its motors rest on whole steps, so this makes the parks of all
/// axes exact.
Program way_to_parks(const activity::Homing& homing, const LoopView& loop) {
    const MotorSet motors = motors_homed_by_touch(homing.sequence.axes(), loop);
    const AxisCounts here = loop.counts();
    Program way{.name = "park", .axes = {}, .start_mm = {}, .blocks = {}};
    ProgramMove move{.target_mm = {}, .rapid = true, .arc = {}, .mode = PathMode::ExactStop};
    for (const AxisIndex i : axis_indices(here.size())) {
        const AxisConfig& axis = loop.machine.axes[i];
        if ((loop.kinematics.motors_of_axes({i}) & motors).empty()) { continue; }
        way.axes.push_back(axis.name);
        way.start_mm.push_back(to_mm(axis, static_cast<double>(here[i])));
        move.target_mm.push_back(axis.homing.park_mm);
    }
    way.blocks.push_back({{}, std::move(move)});
    return way;
}

void begin_homing_move(activity::Homing& homing, const Program& move, JobLifecycle& jobs, CoordinatorLoop& loop) {
    const auto program = commands::known_program(move, loop.machine);
    check(program.has_value(), "the rules of the machine's file bound how far a search goes on behind its touch");
    const AxisCounts here = loop.counts();
    if (const auto fits = jobs.path().planner().check_start((*program)->head(), here); !fits) {
        return jobs.fail({fits.error().fault}, loop);
    }
    PathTask task{.job = jobs.begin_in_pause(JobKind::Home, *program, here, loop), .from = here};
    const PathNext next = jobs.path().begin_leg(task, loop, loop.out.events);
    if (!std::holds_alternative<EpochBegun>(next)) {  // it touches already, or no motor has to move
        return go_on_homing(homing, task, std::holds_alternative<Probed>(next), jobs, loop);
    }
    activity::OnPath moving{{}, std::move(task), {}, {}, homing};
    jobs.activity().become(MachineEvent::EpochBegins, std::move(moving), loop.out);
}

void advance_touch(activity::Homing& homing, JobLifecycle& jobs, CoordinatorLoop& loop) {
    TouchHoming& touch = *homing.touch;
    switch (touch.next(loop)) {
        case TouchHoming::Next::Wait: return;
        case TouchHoming::Next::Assume: return assume(touch.axis(), touch.places(), loop);
        case TouchHoming::Next::Move: return begin_homing_move(homing, touch.program(loop), jobs, loop);
        case TouchHoming::Next::End:
            assume(touch.axis(), touch.places(), loop);
            homing.by_touch.erase(touch.axis());
            homing.skew.begin(loop.axes);
            return homing.touch.reset();
        case TouchHoming::Next::Fail:
            return jobs.fail({touch.fault(), loop.kinematics.motors_of_axes({touch.axis()}).front()}, loop);
    }
}

/// Those of several motors of an axis that have switches.
MotorSet approaching_motors(AxisSet axes, const LoopView& loop) {
    MotorSet motors;
    for (const AxisIndex i : axes) {
        const AxisConfig& axis = loop.machine.axes[i];
        if (axis.motors.size() < 2 || !row_of(axis.homing.way).stops_itself) { continue; }
        motors |= loop.kinematics.motors_of_axes({i});
    }
    return motors;
}

}  // namespace

void go_on_homing(activity::Homing& homing, const PathTask& task, bool probed, JobLifecycle& jobs,
                  PublishingLoop& loop) {
    if (probed) { loop.out.jobs.push_back(job_events::probed(task, jobs.path())); }
    loop.out.jobs.push_back(job_events::ended(task.job, JobOutcome::Done));
    if (homing.touch) { homing.touch->moved(probed ? jobs.path().probing().result() : std::nullopt, loop); }
}

void advance_homing(activity::Homing& homing, JobLifecycle& jobs, CoordinatorLoop& loop) {
    if (!homing.touch) {  // frames keep the motors of an axis together, from where they are assumed to be
        if (const auto motor = homing.skew.look(loop.axes)) {
            return jobs.fail({FaultCode::MotorsSkewed, *motor}, loop);
        }
    }
    for (const MotorIndex m : motor_indices(loop.axes.size())) {
        if (!loop.is_order_done(m)) { return; }
        const auto& order = loop.orders.newest(m);
        const auto& state = loop.axes.state(m);
        const bool refused = state && state->command_fault != FaultCode::None;
        if (refused && order && is_of_homing(order->kind)) { return jobs.fail({state->command_fault, m}, loop); }
    }
    if (homing.has_assumed && !are_places_repeated(loop.axes.views())) { return; }
    if (homing.touch) { return advance_touch(homing, jobs, loop); }
    if (home_next_group(homing, loop)) { return; }
    if (!homing.has_assumed) { return jobs.end(JobOutcome::Done, loop); }
    if (!std::exchange(homing.has_parked, true)) {
        return begin_homing_move(homing, way_to_parks(homing, loop), jobs, loop);
    }
    homing.has_assumed = false;
    take_places(homing, loop);
}

bool home_next_group(activity::Homing& homing, CoordinatorLoop& loop) {
    if (!homing.approaching.empty()) {
        loop.order_each(std::exchange(homing.approaching, {}), AxisCommandKind::Home);
        return true;
    }
    if (!homing.by_touch.empty()) {
        if (!std::exchange(homing.has_assumed, true)) { assume_places(homing, loop); }
        homing.touch.emplace(homing.by_touch.front(), loop.machine);
        return true;
    }
    const AxisSet group = homing.sequence.next_group(loop.machine);
    homing.by_touch = axes_homed_by_touch(group, loop.machine);
    const MotorSet by_touch = motors_homed_by_touch(homing.sequence.axes(), loop);
    homing.approaching = approaching_motors(group, loop) - by_touch;
    loop.order_each(homing.approaching, AxisCommandKind::Approach);
    loop.order_each(loop.kinematics.motors_of_axes(group) - homing.approaching - by_touch, AxisCommandKind::Home);
    homing.skew.begin(loop.axes);
    return !group.empty();
}

}  // namespace lockstep
