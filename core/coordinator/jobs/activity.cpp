#include "core/coordinator/jobs/activity.hpp"

#include <algorithm>
#include <concepts>
#include <type_traits>
#include <utility>

#include "core/check.hpp"

namespace lockstep {
namespace {

struct PhaseOf {
    static MachinePhase of_motion(const activity::Motion& motion, MachinePhase phase) {
        return motion.intent == Intent::GoOn ? phase : MachinePhase::Stopping;
    }
    MachinePhase operator()(const activity::Standby&) const { return MachinePhase::Standby; }
    MachinePhase operator()(const activity::Waiting&) const { return MachinePhase::Waiting; }
    MachinePhase operator()(const activity::Idle&) const { return MachinePhase::Idle; }
    MachinePhase operator()(const activity::Homing& homing) const { return of_motion(homing, MachinePhase::Homing); }
    MachinePhase operator()(const activity::OwnMoves& moves) const { return of_motion(moves, MachinePhase::Running); }
    MachinePhase operator()(const activity::Jogging& jog) const { return of_motion(jog, MachinePhase::Jogging); }
    MachinePhase operator()(const activity::OnPath& path) const {
        if (path.task.job.kind == JobKind::Home) { return of_motion(path, MachinePhase::Homing); }
        return of_motion(path, path.jog ? MachinePhase::Jogging : MachinePhase::Running);
    }
    MachinePhase operator()(const activity::Paused&) const { return MachinePhase::Paused; }
    MachinePhase operator()(const activity::Holding&) const { return MachinePhase::Holding; }
    MachinePhase operator()(const activity::InFault&) const { return MachinePhase::Fault; }
};

/// Pointers into a const variant are to const.
template <typename In, typename T>
using ConstAs = std::conditional_t<std::is_const_v<In>, const T, T>;

template <typename AnyActivity>
auto* motion_in(AnyActivity& any) {
    using Motion = ConstAs<AnyActivity, activity::Motion>;
    return std::visit(
        [](auto& kind) -> Motion* {
            if constexpr (std::derived_from<std::remove_cvref_t<decltype(kind)>, activity::Motion>) { return &kind; }
            return nullptr;
        },
        any);
}

template <typename AnyActivity>
auto* job_in(AnyActivity& any) {
    using Job = ConstAs<AnyActivity, MachineJob>;
    return std::visit(
        [](auto& kind) -> Job* {
            if constexpr (requires { kind.task; }) { return &kind.task.job; }
            if constexpr (requires { kind.job; }) { return &kind.job; }
            return nullptr;
        },
        any);
}

template <typename AnyActivity>
auto* pause_in(AnyActivity& any) {
    using Paused = ConstAs<AnyActivity, activity::Paused>;
    return std::visit(
        [](auto& kind) -> Paused* {
            if constexpr (requires { kind.pause; }) {
                if (kind.pause) { return &*kind.pause; }
            }
            return nullptr;
        },
        any);
}

}  // namespace

MachinePhase MachineActivity::phase() const { return std::visit(PhaseOf{}, activity_); }

MachineFault MachineActivity::fault() const {
    if (const auto* at_rest = as<activity::InFault>()) { return at_rest->fault; }
    const activity::Motion* const moving = motion_in(activity_);
    return moving != nullptr ? moving->fault : MachineFault{};
}

bool MachineActivity::is_jogging() const {
    const auto* jog = as<activity::Jogging>();
    return jog != nullptr && jog->intent == Intent::GoOn;
}

bool MachineActivity::in_motion() const { return motion_in(activity_) != nullptr; }

Intent MachineActivity::intent() const {
    const activity::Motion* const motion = motion_in(activity_);
    return motion != nullptr ? motion->intent : Intent::GoOn;
}

const MachineJob* MachineActivity::job() const { return job_in(activity_); }
MachineJob* MachineActivity::job() { return job_in(activity_); }

const activity::Paused* MachineActivity::pause() const { return pause_in(activity_); }
activity::Paused* MachineActivity::pause() { return pause_in(activity_); }

const MachineState* MachineActivity::inherited() const {
    const auto* const waiting = as<activity::Waiting>();
    return waiting != nullptr && waiting->inherited ? &*waiting->inherited : nullptr;
}

void MachineActivity::become(MachineEvent event, Activity next, CoordinatorOutputs& out) {
    const MachinePhase from = phase();
    activity_ = std::move(next);
    note(event, from, out);
}

void MachineActivity::bring_to_rest(Intent intent, CoordinatorOutputs& out) {
    const MachinePhase from = phase();
    activity::Motion& moving = check_found(motion_in(activity_), "only a motion is brought to rest");
    moving.intent = std::max(moving.intent, intent);
    note(MachineEvent::StopAsked, from, out);
}

void MachineActivity::abort(const MachineFault& fault, CoordinatorOutputs& out) {
    const MachinePhase from = phase();
    activity::Motion& moving = check_found(motion_in(activity_), "only a motion is aborted");
    moving.intent = Intent::Abort;
    moving.fault = fault;
    note(MachineEvent::FailsInMotion, from, out);
}

void MachineActivity::note(MachineEvent event, MachinePhase from, CoordinatorOutputs& out) {
    const auto row = find_transition(from, event);
    check(row && kMachineTransitions[*row].to == phase(), "a change of the machine's phase is in its table");
    out.transitions.push_back(*row);
    if (from == phase()) { return; }
    out.notices.push_back({CoordinatorNotice::Kind::Phase, FaultCode::None, static_cast<std::uint64_t>(phase())});
}

}  // namespace lockstep
