#include "core/coordinator/coordinator.hpp"

#include <algorithm>
#include <limits>
#include <utility>

#include "core/motion/interpolate.hpp"

namespace lockstep {

Coordinator::Coordinator(const MachineConfig& machine, Identity identity, std::uint64_t config_hash,
                         BeginSteps begin_steps, std::optional<OnTakeover> standby)
    : machine_(machine),
      config_hash_(config_hash),
      begin_steps_(begin_steps),
      standby_(standby),
      slot_(machine.slot_ticks()),
      ownership_(identity, machine.timing),
      planner_(machine),
      runner_(machine),
      views_(machine.axes.size()),
      orders_(machine.axes.size()) {}

void Coordinator::accept_program(std::uint64_t id, Program program) {
    if (!programs_.contains(id)) { program_order_.push_back(id); }
    programs_[id] = std::make_shared<const Program>(std::move(program));
    if (program_order_.size() > kProgramsKept) {
        programs_.erase(program_order_.front());
        program_order_.erase(program_order_.begin());
    }
}

CoordinatorOutputs Coordinator::step(const CoordinatorInputs& inputs) {
    CoordinatorOutputs out;
    now_ = inputs.now;
    now_slot_ = rules::slot_of(now_, slot_);
    forgive_own_stall();
    hear(inputs, out);
    change_owner(out);
    if (!ownership_.owns()) {
        stand_by(out);
        return out;
    }
    if (must_listen()) { return out; }
    watch_axes(out);
    for (const Command& command : std::exchange(commands_, {})) { take_command(command, out); }
    if (!begins_slot()) { return out; }
    advance(out);
    for (Frame& frame : out.frames) { frame.term = ownership_.term(); }
    for (std::size_t i = 0; i < orders_.size(); ++i) {
        if (orders_[i] && !order_done(i)) { out.axis_commands.push_back(*orders_[i]); }
    }
    if (moving_ && job_) { note_progress(); }
    out.state = state();
    return out;
}

bool Coordinator::begins_slot() {
    if (state_slot_ && now_slot_ <= *state_slot_) { return false; }
    state_slot_ = now_slot_;
    return true;
}

/// Whom it has not heard because it did not run is not silent.
void Coordinator::forgive_own_stall() {
    const Slot missed = state_slot_ ? std::max<Slot>(0, now_slot_ - *state_slot_ - 1) : 0;
    for (AxisView& view : views_) { view.heard += missed; }
    if (missed > rules::silence_slots(machine_.timing)) { woken_ = now_slot_; }
}

void Coordinator::hear(const CoordinatorInputs& inputs, CoordinatorOutputs& out) {
    for (const AxisState& state : inputs.axes) {
        if (state.axis >= views_.size()) { continue; }
        AxisView& view = views_[state.axis];
        const bool same = view.state && view.state->identity == state.identity;
        if (state.stamp > now_slot_ + rules::kHopSlots || (same && state.stamp < view.state->stamp)) { continue; }
        const bool is_older = view.state && state.stamp <= view.state->stamp;
        if (is_older && !same && present(state.axis)) { continue; }  // of a process before, sent again
        if (view.state && !same && !view.stranger.again(state.identity, state.stamp)) { continue; }
        ownership_.hear(state);
        if (!present(state.axis)) { out.notices.push_back({CoordinatorNotice::Kind::AxisSeen, {}, state.axis}); }
        if (view.state && !same && job_) { fail(FaultCode::AxisLost, state.axis, out); }  // held or not
        if (!same) { orders_[state.axis].reset(); }
        if (view.state && !same) { cut_inherited(TakeoverDoubt::AxisInDoubt, out); }
        const bool is_repeat = same && state.stamp == view.state->stamp;
        const Slot last_stamp = view.state ? view.state->stamp : 0;
        const bool has_order_open = !order_done(state.axis);
        view = {state, now_slot_, is_repeat ? view.stamp_before : last_stamp, {}};
        if (state.term != ownership_.term() || state.command_done <= order_sequence_) { continue; }
        // It has carried out an order that nobody here has given, and takes none with a lower number any more.
        order_sequence_ = state.command_done;
        if (has_order_open) { orders_[state.axis]->sequence = ++order_sequence_; }
    }
    for (const MachineState& other : inputs.others) { ownership_.hear(other, now_slot_); }
    commands_.insert(commands_.end(), inputs.commands.begin(), inputs.commands.end());
}

std::optional<std::size_t> Coordinator::missing_axis() const {
    for (std::size_t i = 0; i < views_.size(); ++i) {
        if (!present(i)) { return i; }
    }
    return std::nullopt;
}

std::optional<std::size_t> Coordinator::axis_without_device() const {
    constexpr auto kMissing = static_cast<std::uint16_t>(FaultCode::DeviceMissing);
    const auto lacks = [](const AxisView& view) { return view.state && view.state->unproved == kMissing; };
    const auto found = std::ranges::find_if(views_, lacks);
    return found == views_.end() ? std::nullopt : std::optional<std::size_t>(found - views_.begin());
}

/// Whether an axis's clock may be further off than this.
bool Coordinator::is_uncertain(std::size_t axis, Ticks limit) const {
    return views_[axis].state && views_[axis].state->clock_error > limit;
}

/// Who is there, who is not, and who is in trouble.
void Coordinator::watch_axes(CoordinatorOutputs& out) {
    if (phase_ == MachinePhase::Idle && axis_without_device()) { enter(MachinePhase::Waiting, out); }
    for (std::size_t i = 0; i < views_.size(); ++i) {
        const AxisView& view = views_[i];
        if (view.state && !present(i)) {
            out.notices.push_back({CoordinatorNotice::Kind::AxisGone, FaultCode::AxisLost, i});
            views_[i].state.reset();
            orders_[i].reset();  // what comes back may be another process: it must not do what this one has done
            cut_inherited(TakeoverDoubt::AxisInDoubt, out);
            if (phase_ == MachinePhase::Idle) { enter(MachinePhase::Waiting, out); }
            if (phase_ != MachinePhase::Waiting) { fail(FaultCode::AxisLost, i, out); }
        } else if (view.state && view.state->config_hash != config_hash_) {
            fail(FaultCode::ConfigMismatch, i, out);
        } else if (view.state && view.state->fault != 0) {
            const bool being_homed = phase_ == MachinePhase::Homing && !order_done(i);
            const bool being_reset = orders_[i] && orders_[i]->kind == AxisCommandKind::Reset && !order_done(i);
            if (!being_homed && !being_reset) { fail(static_cast<FaultCode>(view.state->fault), i, out); }
        } else if (moving_ && is_uncertain(i, machine_.clock_error_limit())) {
            fail(FaultCode::ClockUncertain, i, out);
        }
    }
}

void Coordinator::order(std::size_t axis, AxisCommandKind kind) {
    orders_[axis] = AxisCommand{ownership_.term(), ++order_sequence_, static_cast<std::uint32_t>(axis), kind};
}

/// An axis counts the commands of the owner that it follows: what it did for the last one is no answer to this one.
bool Coordinator::order_done(std::size_t axis) const {
    if (!orders_[axis]) { return true; }
    const auto& state = views_[axis].state;
    return state && state->term == orders_[axis]->term && state->command_done >= orders_[axis]->sequence;
}

/// A fault during motion stops it on the path first; Fault is entered at rest.
void Coordinator::fail(FaultCode fault, std::size_t axis, CoordinatorOutputs& out) {
    if (fault_ != FaultCode::None) { return; }
    fault_ = fault;
    fault_axis_ = axis;
    out.notices.push_back({CoordinatorNotice::Kind::Fault, fault, axis});
    if (in_motion()) {
        intent_ = Intent::Abort;
        moving_ ? runner_.stop(now_slot_) : halt_own();
        return enter(MachinePhase::Stopping, out);
    }
    cut_inherited(TakeoverDoubt::AxisInDoubt, out);
    end_job(JobOutcome::Failed, out);
    enter(MachinePhase::Fault, out);
}

void Coordinator::enter(MachinePhase phase, CoordinatorOutputs& out) {
    if (phase == phase_) { return; }
    phase_ = phase;
    out.notices.push_back({CoordinatorNotice::Kind::Phase, FaultCode::None, static_cast<std::uint64_t>(phase)});
}

AxisCounts Coordinator::counts() const {
    AxisCounts counts;
    for (const AxisView& view : views_) { counts.append(view.state ? view.state->position.count() : 0); }
    return counts;
}

MachineState Coordinator::state() const {
    MachineState s{.term = ownership_.term(),
                   .stamp = now_slot_,
                   .tick = now_,
                   .phase = phase_,
                   .fault = static_cast<std::uint16_t>(fault_),
                   .fault_axis = static_cast<std::uint32_t>(fault_axis_),
                   .epoch = runner_.epoch(),
                   .sent = runner_.sent(),
                   .veto = runner_.veto(),
                   .job = jobs_,
                   .outcome = job_ || inherited_ ? std::nullopt : outcome_,
                   .job_begun = job_begun_,
                   .line = jobs_ == cut_job_ ? cut_line_ : 0,
                   .overrides = overrides_,
                   .config_hash = config_hash_};
    for (std::size_t i = 0; i < views_.size(); ++i) { s.axes_present |= present(i) ? axis_bit(i) : 0; }
    if (in_own_move()) { say_progress_of_own(s); }
    if (inherited_) {
        s.line = inherited_->line;
        s.progress = inherited_->progress;
    }
    if (moving_ && job_) { say_progress(s); }
    if (moving_ && job_ && intent_ == Intent::GoOn) { say_rests(s); }
    return s;
}

/// For a standby. By the LAI method a block is planned in parts, which no place on the program tells apart.
void Coordinator::say_rests(MachineState& state) const {
    if (machine_.coordination == StepMethod::Lai) { return; }
    FrameNumber oldest = runner_.sent();
    for (const AxisView& view : views_) {
        const bool follows = view.state && view.state->epoch == runner_.epoch();
        oldest = std::min(oldest, follows ? view.state->ran : 0);
    }
    state.job_kind = job_->kind;
    state.program = job_->program_id;
    state.rests = runner_.rests_from(oldest);
}

Subticks Coordinator::into_path() const {
    return std::clamp(subticks(now_ - runner_.start()), Subticks{}, runner_.path().duration());
}

/// By what is planned of it now.
Subticks Coordinator::left_of_job() const {
    Subticks left = runner_.path().duration() - into_path();
    for (std::size_t i = job_->leg + 1; i < job_->legs.size(); ++i) { left = left + job_->legs[i].duration; }
    return left;
}

/// Of what was left a slot ago, the share that has been done since: as long as the plan stays, that adds up to the
/// share of its time; where what is left is planned anew, it goes on from there.
void Coordinator::note_progress() {
    const Subticks done = job_->run + into_path();
    if (done <= job_->counted) { return; }
    const auto since = static_cast<double>((done - job_->counted).value);
    const auto left = static_cast<double>(left_of_job().value);
    job_->progress = std::min(1.0, job_->progress + (1 - job_->progress) * since / (since + left));
    job_->counted = done;
}

void Coordinator::say_progress(MachineState& state) const {
    state.line = runner_.path().moves[runner_.path().move_at(into_path())].line;
    state.remaining_s = static_cast<double>(left_of_job().value) / kSubticksPerTick / machine_.ticks_per_second();
    state.progress = job_->progress;
}

}  // namespace lockstep
