// The machine's owner and who stands by: taking over, standing down, and what is done meanwhile, which is to listen.
#include <algorithm>
#include <ranges>
#include <utility>

#include "core/check.hpp"
#include "core/coordinator/coordinator.hpp"

namespace lockstep {
namespace {

/// Whoever asks for it does not want the job to go on by itself.
bool is_interrupt(CommandKind kind) {
    return kind == CommandKind::Hold || kind == CommandKind::Stop || kind == CommandKind::EmergencyStop ||
           kind == CommandKind::Reset;
}

}  // namespace

void Coordinator::change_owner(CoordinatorOutputs& out) {
    switch (ownership_.judge(now_, now_slot_, views_)) {
        case Ownership::Change::None: return;
        case Ownership::Change::Claimed: return take_over(out);
        case Ownership::Change::StoodDown: return stand_down(out);
    }
}

/// It says nothing that moves. A command heard now was another's: should it come again, nobody knows whether it was
/// begun. An emergency stop may be done twice.
void Coordinator::stand_by(CoordinatorOutputs& out) {
    for (const Command& command : std::exchange(commands_, {})) {
        if (is_interrupt(command.kind)) { interrupt_heard_ = now_slot_; }
        const FaultText* why = find_fault(FaultCode::CoordinatorChanged);
        if (is_old(command) || command.kind == CommandKind::EmergencyStop) { continue; }
        note_command(command, refused(command, why->code, std::string(why->cause) + "; " + remedy_text(*why)));
    }
    for (std::size_t i = 0; i < views_.size(); ++i) {
        if (!present(i)) { views_[i].state.reset(); }
    }
    out.must_quit = !standby_ && ownership_.has_second_owner(now_slot_);
    if (begins_slot()) { out.state = state(); }
}

/// An owner that stalled for so long that another may have taken over says nothing before it has heard every axis in
/// two slots since: whom do they follow? But for those that are lost.
bool Coordinator::must_listen() {
    if (!woken_) { return false; }
    const auto is_settled = [&](std::size_t i) { return !present(i) || views_[i].stamp_before > *woken_; };
    if (std::ranges::all_of(std::views::iota(std::size_t{0}, views_.size()), is_settled)) { woken_.reset(); }
    if (woken_) { (void)begins_slot(); }
    return woken_.has_value();
}

/// Overrides hold on. The job that the last owner had begun is gone on with, or at its end, wherever the axes came to
/// rest.
void Coordinator::take_over(CoordinatorOutputs& out) {
    out.notices.push_back({CoordinatorNotice::Kind::Claimed, FaultCode::None, ownership_.term().number});
    order_sequence_ = 0;
    enter(MachinePhase::Waiting, out);
    if (const auto& last = ownership_.other_owner(); last && last->job >= jobs_) { inherit(*last, out); }
}

void Coordinator::inherit(const MachineState& last, CoordinatorOutputs& out) {
    jobs_ = last.job;
    job_begun_ = last.job_begun;
    overrides_ = last.overrides;
    outcome_ = last.outcome;
    cut_job_ = 0;
    if (last.job == 0 || last.outcome) { return; }
    inherited_ = last;
    if (const auto doubt = doubt_of_inherited()) { cut_inherited(*doubt, out); }
}

/// Before the axes have been asked.
std::optional<TakeoverDoubt> Coordinator::doubt_of_inherited() const {
    if (standby_ != OnTakeover::Continue) { return TakeoverDoubt::NotAsked; }
    if (inherited_->program == 0) { return TakeoverDoubt::NotRunning; }
    const bool is_late = interrupt_heard_ && *interrupt_heard_ + rules::kHopSlots >= inherited_->stamp;
    if (is_late) { return TakeoverDoubt::Interrupted; }
    if (!programs_.contains(inherited_->program)) { return TakeoverDoubt::UnknownProgram; }
    if (inherited_->config_hash != config_hash_) { return TakeoverDoubt::OtherPlan; }
    return missing_axis() ? std::optional(TakeoverDoubt::AxisInDoubt) : std::nullopt;
}

/// Every axis follows this owner and rests.
void Coordinator::go_on_with_inherited(CoordinatorOutputs& out) {
    const auto found = programs_.find(inherited_->program);
    check(found != programs_.end(), "the program of an inherited job is known");
    const auto& program = found->second;
    auto rest = rest_of_job(*inherited_, *program, machine_, views_);
    if (!rest) { return cut_inherited(rest.error(), out); }
    const MachineState last = *std::exchange(inherited_, std::nullopt);
    out.notices.push_back(
        {CoordinatorNotice::Kind::JobContinued, FaultCode::None, static_cast<std::uint64_t>(last.line)});
    job_ = Job{.number = jobs_,
               .kind = last.job_kind,
               .program_id = last.program,
               .program = program,
               .legs = std::move(rest->legs),
               .leg = rest->leg,
               .progress = last.progress,
               .resume = rest->place,
               .remaining = std::move(rest->remaining),
               .positions = std::move(rest->positions)};
    time_legs();
    go_on(out);
}

/// The job, if there is one, is at its end.
void Coordinator::cut_inherited(TakeoverDoubt doubt, CoordinatorOutputs& out) {
    if (!inherited_) { return; }
    cut_job_ = jobs_;
    cut_line_ = inherited_->line;
    outcome_ = JobOutcome::Stopped;
    inherited_.reset();
    out.notices.push_back(
        {CoordinatorNotice::Kind::JobCutShort, FaultCode::None, static_cast<std::uint64_t>(cut_line_), doubt});
}

/// What it had begun is no longer its own: the axes have come to rest without it.
void Coordinator::stand_down(CoordinatorOutputs& out) {
    out.notices.push_back({CoordinatorNotice::Kind::StoodDown, FaultCode::None, ownership_.term().number});
    if (job_) { outcome_ = JobOutcome::Stopped; }
    job_.reset();
    inherited_.reset();
    interrupt_heard_.reset();
    moving_ = false;
    intent_ = Intent::GoOn;
    fault_ = FaultCode::None;
    std::ranges::fill(orders_, std::nullopt);
    enter(MachinePhase::Standby, out);
}

}  // namespace lockstep
