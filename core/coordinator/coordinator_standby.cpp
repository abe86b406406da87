// The machine's owner and who stands by: taking over, standing down, and what is done meanwhile, which is to listen.
#include <algorithm>

#include "core/coordinator/coordinator.hpp"

namespace lockstep {

void Coordinator::change_owner(CoordinatorOutputs& out) {
    switch (ownership_.judge(now_, now_slot_, views_)) {
        case Ownership::Change::None: return;
        case Ownership::Change::Claimed: return take_over(out);
        case Ownership::Change::StoodDown: return stand_down(out);
    }
}

/// It says nothing that moves. A command heard now was another's: should it come again, nobody knows whether it was
/// begun. An emergency stop may be done twice.
void Coordinator::stand_by(const CoordinatorInputs& inputs, CoordinatorOutputs& out) {
    for (const Command& command : inputs.commands) {
        const FaultText* why = find_fault(FaultCode::CoordinatorChanged);
        if (is_old(command) || command.kind == CommandKind::EmergencyStop) { continue; }
        note_command(command, refused(command, why->code, std::string(why->cause) + "; " + std::string(why->remedy)));
    }
    for (std::size_t i = 0; i < views_.size(); ++i) {
        if (!present(i)) { views_[i].state.reset(); }
    }
    out.must_quit = !to_stand_by_ && ownership_.hears_other_owner(now_slot_);
    if (begins_slot()) { out.state = state(); }
}

/// An owner that stalled for so long that another may have taken over says nothing before it has heard every axis in
/// two slots since: whom do they follow?
bool Coordinator::must_listen() {
    if (!woken_) { return false; }
    const bool heard = std::ranges::all_of(
        views_, [&](const AxisView& view) { return view.state && view.state->stamp > *woken_ + 1; });
    if (heard || now_slot_ - *woken_ > rules::silence_slots(machine_.timing)) { woken_.reset(); }
    if (woken_) { (void)begins_slot(); }
    return woken_.has_value();
}

/// A job that the last owner had begun is at its end, wherever the axes came to rest. Overrides hold on.
void Coordinator::take_over(CoordinatorOutputs& out) {
    out.notices.push_back({CoordinatorNotice::Kind::Claimed, FaultCode::None, ownership_.term().number});
    if (const auto& last = ownership_.other_owner(); last && last->job >= jobs_) {
        const bool in_progress = last->job > 0 && !last->outcome;
        jobs_ = last->job;
        overrides_ = last->overrides;
        outcome_ = in_progress ? JobOutcome::Stopped : last->outcome;
        cut_job_ = in_progress ? jobs_ : 0;
        cut_line_ = last->line;
        if (in_progress) {
            out.notices.push_back(
                {CoordinatorNotice::Kind::JobCutShort, FaultCode::None, static_cast<std::uint64_t>(cut_line_)});
        }
    }
    order_sequence_ = 0;
    enter(MachinePhase::Waiting, out);
}

/// What it had begun is no longer its own: the axes have come to rest without it.
void Coordinator::stand_down(CoordinatorOutputs& out) {
    out.notices.push_back({CoordinatorNotice::Kind::StoodDown, FaultCode::None, ownership_.term().number});
    if (job_) { outcome_ = JobOutcome::Stopped; }
    job_.reset();
    moving_ = false;
    intent_ = Intent::GoOn;
    fault_ = FaultCode::None;
    std::ranges::fill(orders_, std::nullopt);
    enter(MachinePhase::Standby, out);
}

}  // namespace lockstep
