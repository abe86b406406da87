#include "core/coordinator/coordinator.hpp"

#include <algorithm>
#include <limits>

#include "core/motion/interpolate.hpp"

namespace lockstep {

Coordinator::Coordinator(const MachineConfig& machine, Identity identity, std::uint64_t config_hash)
    : machine_(machine),
      identity_(identity),
      config_hash_(config_hash),
      slot_(machine.slot_ticks()),
      planner_(machine),
      runner_(machine, identity),
      views_(machine.axes.size()),
      orders_(machine.axes.size()),
      order_sequence_(identity << 8) {}

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
    if (!first_slot_) { first_slot_ = now_slot_; }
    hear(inputs, out);
    watch_axes(out);
    for (const Command& command : inputs.commands) { take_command(command, out); }
    if (state_slot_ && now_slot_ <= *state_slot_) { return out; }
    state_slot_ = now_slot_;
    advance(out);
    for (std::size_t i = 0; i < orders_.size(); ++i) {
        if (orders_[i] && !order_done(i)) { out.axis_commands.push_back(*orders_[i]); }
    }
    out.state = state();
    return out;
}

// ---- What is heard -----------------------------------------------------------------------------------------------

void Coordinator::hear(const CoordinatorInputs& inputs, CoordinatorOutputs& out) {
    for (const AxisState& state : inputs.axes) {
        if (state.axis >= views_.size()) { continue; }
        AxisView& view = views_[state.axis];
        const bool same = view.state && view.state->identity == state.identity;
        if (same && state.stamp < view.state->stamp) { continue; }
        if (!present(state.axis)) { out.notices.push_back({CoordinatorNotice::Kind::AxisSeen, {}, state.axis}); }
        if (view.state && !same && moving_) { fail(FaultCode::AxisLost, state.axis, out); }
        if (!same) { orders_[state.axis].reset(); }
        view = {state, now_slot_};
    }
    // Who came later gives way; both hear each other within a slot or two.
    out.must_quit = std::any_of(inputs.others.begin(), inputs.others.end(), [&](const MachineState& other) {
        return other.coordinator != identity_ && other.coordinator < identity_;
    });
}

std::optional<std::size_t> Coordinator::missing_axis() const {
    for (std::size_t i = 0; i < views_.size(); ++i) {
        if (!present(i)) { return i; }
    }
    return std::nullopt;
}

/// Who is there, who is not, and who is in trouble.
void Coordinator::watch_axes(CoordinatorOutputs& out) {
    for (std::size_t i = 0; i < views_.size(); ++i) {
        const AxisView& view = views_[i];
        if (view.state && !present(i)) {
            out.notices.push_back({CoordinatorNotice::Kind::AxisGone, FaultCode::AxisLost, i});
            views_[i].state.reset();
            if (phase_ == MachinePhase::Idle) { enter(MachinePhase::Waiting, out); }
            if (phase_ != MachinePhase::Waiting) { fail(FaultCode::AxisLost, i, out); }
        } else if (view.state && view.state->config_hash != config_hash_) {
            fail(FaultCode::ConfigMismatch, i, out);
        } else if (view.state && view.state->fault != 0) {
            const bool being_homed = phase_ == MachinePhase::Homing && !order_done(i);
            const bool being_reset = orders_[i] && orders_[i]->kind == AxisCommandKind::Reset && !order_done(i);
            if (!being_homed && !being_reset) { fail(static_cast<FaultCode>(view.state->fault), i, out); }
        }
    }
}

// ---- Commands ----------------------------------------------------------------------------------------------------

void Coordinator::take_command(const Command& command, CoordinatorOutputs& out) {
    const auto last = replies_.find(command.client);
    if (last != replies_.end() && command.sequence <= last->second.sequence) {
        if (command.sequence == last->second.sequence) { out.replies.push_back(last->second); }
        return;
    }
    const Reply reply = answer(command, out);
    if (replies_.size() >= kClientsRemembered) { replies_.erase(replies_.begin()); }
    replies_[command.client] = reply;
    out.replies.push_back(reply);
}

Reply Coordinator::answer(const Command& command, CoordinatorOutputs& out) {
    switch (command.kind) {
        case CommandKind::Home: return home(command, out);
        case CommandKind::Move:
        case CommandKind::Run: return run(command, out);
        case CommandKind::Hold: return interrupt(command, Intent::Hold, out);
        case CommandKind::Stop: return interrupt(command, Intent::Stop, out);
        case CommandKind::Resume: return resume(command, out);
        case CommandKind::Reset: return reset(command, out);
        case CommandKind::EmergencyStop: return emergency(command, out);
    }
    return refused(command, FaultCode::NothingToDo, "unknown command");
}

Reply Coordinator::accepted(const Command& command) const {
    return {command.client, command.sequence, ReplyStatus::Accepted, 0, job_ ? job_->number : jobs_, {}};
}

Reply Coordinator::refused(const Command& command, FaultCode why, std::string text) {
    return {command.client, command.sequence, ReplyStatus::Refused, static_cast<std::uint16_t>(why), 0, std::move(text)};
}

std::optional<Reply> Coordinator::refuse_unless_ready(const Command& command) const {
    if (const auto missing = missing_axis()) {
        return refused(command, FaultCode::AxisMissing, "axis " + machine_.axes[*missing].name + " is not heard");
    }
    if (phase_ == MachinePhase::Fault) {
        return refused(command, FaultCode::InFault, "the machine is in Fault: " + std::string(name_of(fault_)));
    }
    if (phase_ != MachinePhase::Idle) { return refused(command, FaultCode::Busy, "the machine is not idle"); }
    return std::nullopt;
}

Reply Coordinator::home(const Command& command, CoordinatorOutputs& out) {
    if (auto refusal = refuse_unless_ready(command)) { return *refusal; }
    const auto all = static_cast<std::uint32_t>((std::uint64_t{1} << views_.size()) - 1);
    if ((command.axes & ~all) != 0) { return refused(command, FaultCode::BadProgram, "no such axis"); }
    job_ = Job{.number = ++jobs_, .kind = JobKind::Home, .axes = command.axes == 0 ? all : command.axes};
    job_->sequence = std::numeric_limits<int>::min();
    out.jobs.push_back({.kind = JobEvent::Kind::Begun, .job = job_->number, .job_kind = JobKind::Home});
    enter(MachinePhase::Homing, out);
    send_homing_group(out);
    return accepted(command);
}

Reply Coordinator::run(const Command& command, CoordinatorOutputs& out) {
    if (auto refusal = refuse_unless_ready(command)) { return *refusal; }
    const auto program = programs_.find(command.program);
    if (program == programs_.end()) { return refused(command, FaultCode::UnknownProgram, "the program has not arrived whole"); }
    for (std::size_t i = 0; i < views_.size(); ++i) {
        if (!views_[i].state->homed) {
            return refused(command, FaultCode::NotHomed, "axis " + machine_.axes[i].name + " is not homed");
        }
    }
    auto plan = planner_.plan(*program->second, counts());
    if (!plan) {
        const std::string line = plan.error().line > 0 ? "line " + std::to_string(plan.error().line) + ": " : "";
        return refused(command, plan.error().fault, line + plan.error().text);
    }
    job_ = Job{.number = ++jobs_,
               .kind = command.kind == CommandKind::Move ? JobKind::Move : JobKind::Run,
               .program = program->second,
               .legs = std::move(*plan)};
    for (const Leg& leg : job_->legs) {
        if (!leg.moves.empty()) { job_->planned = job_->planned + planner_.path(leg.moves, {}).duration(); }
    }
    const AxisCounts start = counts();
    out.jobs.push_back({.kind = JobEvent::Kind::Begun, .job = job_->number, .job_kind = job_->kind,
                        .program = job_->program, .start_counts = {start.begin(), start.end()}});
    const Reply reply = accepted(command);
    begin_leg(out);
    return reply;
}

Reply Coordinator::interrupt(const Command& command, Intent intent, CoordinatorOutputs& out) {
    const bool resting = phase_ == MachinePhase::Holding || phase_ == MachinePhase::Paused;
    if (intent == Intent::Stop && resting && !moving_) {
        const Reply reply = accepted(command);
        end_job(JobOutcome::Stopped, out);
        return reply;
    }
    if (!moving_) { return refused(command, FaultCode::NothingToDo, "nothing is in motion that could be interrupted"); }
    intent_ = std::max(intent_, intent);
    runner_.stop(now_slot_);
    enter(MachinePhase::Stopping, out);
    return accepted(command);
}

Reply Coordinator::resume(const Command& command, CoordinatorOutputs& out) {
    const bool resting = phase_ == MachinePhase::Holding || phase_ == MachinePhase::Paused;
    if (!resting || moving_) { return refused(command, FaultCode::NothingToDo, "nothing is held or paused"); }
    if (const auto missing = missing_axis()) {
        return refused(command, FaultCode::AxisMissing, "axis " + machine_.axes[*missing].name + " is not heard");
    }
    phase_ == MachinePhase::Paused ? begin_leg(out) : go_on(out);
    return accepted(command);
}

Reply Coordinator::reset(const Command& command, CoordinatorOutputs& out) {
    if (moving_ || phase_ == MachinePhase::Homing) { return refused(command, FaultCode::Busy, "the machine is in motion"); }
    if (job_) { end_job(JobOutcome::Stopped, out); }
    for (std::size_t i = 0; i < views_.size(); ++i) { order(i, AxisCommandKind::Reset); }
    fault_ = FaultCode::None;
    enter(MachinePhase::Waiting, out);
    return accepted(command);
}

Reply Coordinator::emergency(const Command& command, CoordinatorOutputs& out) {
    for (std::size_t i = 0; i < views_.size(); ++i) { order(i, AxisCommandKind::StopNow); }
    fail(FaultCode::EmergencyStopped, 0, out);
    return accepted(command);
}

// ---- Orders to axes ----------------------------------------------------------------------------------------------

void Coordinator::order(std::size_t axis, AxisCommandKind kind) {
    orders_[axis] = AxisCommand{identity_, ++order_sequence_, static_cast<std::uint32_t>(axis), kind};
}

bool Coordinator::order_done(std::size_t axis) const {
    return !orders_[axis] || (views_[axis].state && views_[axis].state->command_done >= orders_[axis]->sequence);
}

void Coordinator::send_homing_group(CoordinatorOutputs& out) {
    std::optional<int> group;
    for (std::size_t i = 0; i < views_.size(); ++i) {
        const int sequence = machine_.axes[i].homing.sequence;
        const bool later = (job_->axes >> i & 1) != 0 && sequence > job_->sequence;
        if (later && (!group || sequence < *group)) { group = sequence; }
    }
    if (!group) { return end_job(JobOutcome::Done, out); }
    job_->sequence = *group;
    for (std::size_t i = 0; i < views_.size(); ++i) {
        if ((job_->axes >> i & 1) != 0 && machine_.axes[i].homing.sequence == *group) { order(i, AxisCommandKind::Home); }
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

// ---- Motion ------------------------------------------------------------------------------------------------------

void Coordinator::advance(CoordinatorOutputs& out) {
    if (moving_) {
        out.frames = runner_.send(now_slot_, views_);
        if (const auto end = runner_.judge(now_slot_, views_)) { settle(*end, out); }
        return;
    }
    if (phase_ == MachinePhase::Homing) { return advance_homing(out); }
    const bool listened = now_slot_ - *first_slot_ > rules::silence_slots(machine_.timing);
    bool orders_open = false;
    for (std::size_t i = 0; i < orders_.size(); ++i) { orders_open |= !order_done(i); }
    if (phase_ == MachinePhase::Waiting && listened && !missing_axis() && !orders_open) { enter(MachinePhase::Idle, out); }
}

void Coordinator::begin_leg(CoordinatorOutputs& out) {
    while (job_->leg < job_->legs.size() && job_->legs[job_->leg].moves.empty() &&
           !job_->legs[job_->leg].then_pause) {
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

/// `at` empty: from rest on whole steps, where the axes stand.
void Coordinator::begin_epoch(std::vector<PathMove> moves, Displacement along, std::vector<Position> at, PathPlace place,
                              CoordinatorOutputs& out) {
    Path path = planner_.path(std::move(moves), along);
    if (at.empty()) {
        for (std::size_t i = 0; i < views_.size(); ++i) {
            at.push_back(start_of(path, i, views_[i].state->position.count()));
        }
    }
    const Epoch epoch = (identity_ << 8) + ++epochs_;
    runner_.begin(epoch, std::move(path), std::move(at), now_slot_);
    moving_ = true;
    intent_ = Intent::GoOn;
    enter(MachinePhase::Running, out);
    out.notices.push_back({CoordinatorNotice::Kind::EpochBegun, FaultCode::None, epoch});
    out.jobs.push_back({.kind = JobEvent::Kind::EpochBegun, .job = job_->number, .job_kind = job_->kind, .epoch = epoch,
                        .start = runner_.start(), .place = place});
}

/// Everyone is at rest: what now?
void Coordinator::settle(const EpochEnd& end, CoordinatorOutputs& out) {
    moving_ = false;
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
    job_->planned_behind = job_->planned_behind + runner_.path().duration();
    const bool pause = job_->legs[job_->leg].then_pause;
    ++job_->leg;
    if (intent_ == Intent::Stop) { return end_job(JobOutcome::Stopped, out); }
    if (pause || intent_ == Intent::Hold) { return enter(MachinePhase::Paused, out); }
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
    if (job_->remaining.empty()) {
        ++job_->leg;
        return begin_leg(out);
    }
    begin_epoch(std::move(job_->remaining), job_->resume.along, std::move(job_->positions), job_->resume, out);
}

void Coordinator::end_job(JobOutcome outcome, CoordinatorOutputs& out) {
    if (!job_) { return; }
    out.jobs.push_back({.kind = JobEvent::Kind::Ended, .job = job_->number, .job_kind = job_->kind, .outcome = outcome});
    job_.reset();
    outcome_ = outcome;
    enter(MachinePhase::Idle, out);
}

/// A fault during motion stops it on the path first; Fault is entered at rest.
void Coordinator::fail(FaultCode fault, std::size_t axis, CoordinatorOutputs& out) {
    if (fault_ != FaultCode::None) { return; }
    fault_ = fault;
    fault_axis_ = axis;
    out.notices.push_back({CoordinatorNotice::Kind::Fault, fault, axis});
    if (moving_) {
        intent_ = Intent::Abort;
        runner_.stop(now_slot_);
        return enter(MachinePhase::Stopping, out);
    }
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
    for (const AxisView& view : views_) { (void)counts.push_back(view.state ? view.state->position.count() : 0); }
    return counts;
}

MachineState Coordinator::state() const {
    MachineState s{.coordinator = identity_, .stamp = now_slot_, .tick = now_, .phase = phase_,
                   .fault = static_cast<std::uint16_t>(fault_), .fault_axis = static_cast<std::uint32_t>(fault_axis_),
                   .epoch = runner_.epoch(), .sent = runner_.sent(), .veto = runner_.veto(), .job = jobs_,
                   .outcome = job_ ? std::nullopt : outcome_,
                   .config_hash = config_hash_};
    for (std::size_t i = 0; i < views_.size(); ++i) { s.axes_present |= present(i) ? std::uint32_t{1} << i : 0; }
    if (moving_ && job_) {
        const Path& path = runner_.path();
        const Subticks into = std::clamp(subticks(now_ - runner_.start()), Subticks{}, path.duration());
        const double left = static_cast<double>((path.duration() - into).value) / kSubticksPerTick;
        double later = 0;
        const double planned = static_cast<double>((job_->planned - job_->planned_behind).value) / kSubticksPerTick;
        later = std::max(0.0, planned - static_cast<double>(path.duration().value) / kSubticksPerTick);
        const double all = std::max(1.0, static_cast<double>(job_->planned.value) / kSubticksPerTick);
        s.line = path.moves[path.move_at(into)].line;
        s.remaining_s = (left + later) / machine_.ticks_per_second();
        s.progress = std::clamp(1 - (left + later) / all, 0.0, 1.0);
    }
    return s;
}

}  // namespace lockstep
