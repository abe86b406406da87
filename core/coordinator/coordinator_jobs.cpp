// Homing and motion: what happens while a job is in progress, and when its axes have come to rest.
#include "core/coordinator/coordinator.hpp"

#include <algorithm>
#include <optional>

#include "core/motion/interpolate.hpp"

namespace lockstep {

void Coordinator::send_homing_group(CoordinatorOutputs& out) {
    std::optional<int> group;
    for (std::size_t i = 0; i < views_.size(); ++i) {
        const int sequence = machine_.axes[i].homing.sequence;
        const bool later = has_axis(job_->axes, i) && sequence > job_->sequence;
        if (later && (!group || sequence < *group)) { group = sequence; }
    }
    if (!group) { return end_job(JobOutcome::Done, out); }
    job_->sequence = *group;
    for (std::size_t i = 0; i < views_.size(); ++i) {
        if (has_axis(job_->axes, i) && machine_.axes[i].homing.sequence == *group) { order(i, AxisCommandKind::Home); }
    }
}

void Coordinator::advance_homing(CoordinatorOutputs& out) {
    for (std::size_t i = 0; i < views_.size(); ++i) {
        if (!order_done(i)) { return; }
        const bool refused = orders_[i] && views_[i].state && views_[i].state->command_fault != 0;
        if (refused && orders_[i]->kind == AxisCommandKind::Home) {
            return fail(static_cast<FaultCode>(views_[i].state->command_fault), i, out);
        }
    }
    send_homing_group(out);
}

void Coordinator::advance(CoordinatorOutputs& out) {
    if (moving_) {
        out.frames = runner_.send(now_slot_, views_);
        if (const auto turn = runner_.take_turn()) {
            out.jobs.push_back({.kind = JobEvent::Kind::Overridden,
                                .job = job_->number,
                                .job_kind = job_->kind,
                                .epoch = runner_.epoch(),
                                .overrides = turn->overrides,
                                .behind = turn->behind});
        }
        if (const auto end = runner_.judge(now_slot_, views_)) { return settle(*end, out); }
        if (runner_.is_overdue()) { give_up_epoch(out); }
        return;
    }
    if (phase_ == MachinePhase::Homing) { return advance_homing(out); }
    if (axes_move_alone()) { return advance_own(out); }
    const bool acknowledged = ownership_.acknowledged(views_);
    if (phase_ == MachinePhase::Idle && ownership_.lacks_axes(now_slot_)) { enter(MachinePhase::Waiting, out); }
    bool orders_open = false;
    for (std::size_t i = 0; i < orders_.size(); ++i) { orders_open |= !order_done(i); }
    const bool all_rest = std::ranges::all_of(views_, [](const AxisView& v) { return v.state && v.state->at_rest; });
    const bool all_here = !missing_axis() && !axis_without_device();
    if (phase_ != MachinePhase::Waiting || !acknowledged || !all_here || orders_open || !all_rest) { return; }
    if (inherited_) { go_on_with_inherited(out); }
    if (!job_) { enter(MachinePhase::Idle, out); }
}

void Coordinator::begin_leg(CoordinatorOutputs& out) {
    while (job_->leg < job_->legs.size() && job_->legs[job_->leg].moves.empty() && !job_->legs[job_->leg].then_pause) {
        ++job_->leg;
    }
    if (job_->leg == job_->legs.size()) { return end_job(JobOutcome::Done, out); }
    Leg& leg = job_->legs[job_->leg];
    if (leg.moves.empty()) {
        ++job_->leg;
        return enter(MachinePhase::Paused, out);
    }
    begin_epoch(leg.moves, {}, {}, {leg.moves.front().block, {}}, out);
}

/// Above all that any axis has taken frames of, whoever sent them.
Epoch Coordinator::next_epoch() {
    const Term term = ownership_.term();
    epoch_ = std::max(epoch_, first_epoch(term));
    for (const AxisView& view : views_) {
        if (view.state && is_epoch_of(view.state->epoch, term)) { epoch_ = std::max(epoch_, view.state->epoch); }
    }
    return ++epoch_;
}

/// `at` empty: from rest on whole steps, where the axes stand.
void Coordinator::begin_epoch(std::vector<PathMove> moves, Displacement along, std::vector<Position> at,
                              PathPlace place, CoordinatorOutputs& out) {
    Path path = planner_.path(std::move(moves), along, overrides_);
    if (at.empty()) {
        for (std::size_t i = 0; i < views_.size(); ++i) {
            at.push_back(start_of(path, i, views_[i].state->position.count()));
        }
    }
    const Epoch epoch = next_epoch();
    runner_.begin(epoch, std::move(path), std::move(at), now_slot_);
    moving_ = true;
    intent_ = Intent::GoOn;
    enter(MachinePhase::Running, out);
    out.notices.push_back({CoordinatorNotice::Kind::EpochBegun, FaultCode::None, epoch});
    out.jobs.push_back({.kind = JobEvent::Kind::EpochBegun,
                        .job = job_->number,
                        .job_kind = job_->kind,
                        .epoch = epoch,
                        .start = runner_.start(),
                        .place = place,
                        .overrides = overrides_});
}

/// Everyone is at rest: what now?
void Coordinator::settle(const EpochEnd& end, CoordinatorOutputs& out) {
    moving_ = false;
    out.epoch_end = {end.kind, intent_};
    const std::int64_t ticks = static_cast<std::int64_t>(end.ran) * machine_.frame_ticks().value;
    job_->run = job_->run + std::min(subticks(Ticks{ticks}), runner_.path().duration());
    if (intent_ == Intent::Abort) {
        end_job(JobOutcome::Failed, out);
        return enter(MachinePhase::Fault, out);
    }
    switch (end.kind) {
        case EpochEnd::Kind::FramesDiffer: return fail(FaultCode::FramesDiffer, end.axis, out);
        case EpochEnd::Kind::Misplaced: return fail(FaultCode::PositionMismatch, end.axis, out);
        case EpochEnd::Kind::Interrupted: return interrupted(end, out);
        case EpochEnd::Kind::Complete: break;
    }
    if (intent_ == Intent::Stop) { return end_job(JobOutcome::Stopped, out); }
    if (intent_ == Intent::GoOn) { return end_leg(out); }
    ++job_->leg;
    enter(MachinePhase::Paused, out);
}

/// No stop is waited for without end: a person is told who does not come to rest.
void Coordinator::give_up_epoch(CoordinatorOutputs& out) {
    const auto moves = [&](const AxisView& view) {
        return view.present(now_slot_, machine_.timing) && !view.state->at_rest;
    };
    const auto restless = std::ranges::find_if(views_, moves);
    const auto axis = restless == views_.end() ? 0 : restless - views_.begin();
    fail(FaultCode::NotAtRest, static_cast<std::size_t>(axis), out);
    moving_ = false;
    end_job(JobOutcome::Failed, out);
    enter(MachinePhase::Fault, out);
}

void Coordinator::end_leg(CoordinatorOutputs& out) {
    const bool pause = job_->legs[job_->leg].then_pause;
    ++job_->leg;
    if (pause) { return enter(MachinePhase::Paused, out); }
    begin_leg(out);
}

/// The axes rest together on the path, proved by their counts: what is left can be run from there.
void Coordinator::interrupted(const EpochEnd& end, CoordinatorOutputs& out) {
    const auto& moves = runner_.path().moves;
    const bool move_done = end.along >= Displacement::steps(moves[end.move].lead) && moves[end.move].lead != 0;
    const std::size_t first = move_done ? end.move + 1 : end.move;
    job_->remaining.assign(moves.begin() + static_cast<std::ptrdiff_t>(first), moves.end());
    job_->positions = end.positions;
    job_->resume = {move_done ? 0 : moves[end.move].block, move_done ? Displacement{} : end.along};
    if (move_done && !job_->remaining.empty()) { job_->resume.block = job_->remaining.front().block; }
    job_->fruitless = end.ran == 0 ? job_->fruitless + 1 : 0;
    if (intent_ == Intent::Stop) { return end_job(JobOutcome::Stopped, out); }
    if (intent_ == Intent::Hold) { return enter(MachinePhase::Holding, out); }
    out.notices.push_back({CoordinatorNotice::Kind::Interrupted, FaultCode::FrameLate, end.ran});
    if (job_->fruitless >= kMaxFruitless) { return fail(FaultCode::FrameLate, 0, out); }
    go_on(out);
}

void Coordinator::go_on(CoordinatorOutputs& out) {
    if (job_->remaining.empty()) { return end_leg(out); }
    begin_epoch(std::move(job_->remaining), job_->resume.along, std::move(job_->positions), job_->resume, out);
}

void Coordinator::end_job(JobOutcome outcome, CoordinatorOutputs& out) {
    if (!job_) { return; }
    out.jobs.push_back(
        {.kind = JobEvent::Kind::Ended, .job = job_->number, .job_kind = job_->kind, .outcome = outcome});
    job_.reset();
    outcome_ = outcome;
    enter(MachinePhase::Idle, out);
}

}  // namespace lockstep
