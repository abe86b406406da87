#include "clients/session/follow/command_tracker.hpp"

namespace lockstep {

void CommandTracker::number(Identity client, std::uint64_t sequence, std::uint64_t writer) {
    command_.client = client;
    command_.sequence = sequence;
    command_.writer.id = writer;
}

CommandStep CommandTracker::pass(const Reply* reply, const OwnerSight& owner, Time now) {
    if (state_ == State::GaveUp) { return CommandStep::GaveUp; }
    if (reply != nullptr && !reply_) { reply_ = *reply; }
    if (reply_) { return CommandStep::Answered; }
    if (!begun_) { begun_ = now; }
    if (is_new_owner(owner)) {
        ++owners_;
        begun_ = now;
        sent_.reset();
    }
    if (is_overdue(owner, now)) {
        state_ = State::GaveUp;
        return CommandStep::GaveUp;
    }
    if (!is_due(owner, now)) { return CommandStep::Wait; }
    sent_ = now;
    owner_ = owner.owner;
    return CommandStep::Send;
}

void CommandTracker::withdraw(Time now) {
    if (state_ != State::Sending) { return; }
    state_ = sent_ ? State::Withdrawn : State::GaveUp;
    begun_ = now;
}

bool CommandTracker::is_new_owner(const OwnerSight& owner) const {
    return state_ == State::Sending && sent_ && owner.owner != owner_ && owners_ < kMostOwners;
}

bool CommandTracker::is_overdue(const OwnerSight& owner, Time now) const {
    const bool may_plan = state_ == State::Sending && command_.program != 0 && !owner.is_silent;
    return now - *begun_ > (may_plan ? Time{kPlanPatience} : patience_);
}

/// A client that was itself stopped first looks what the machine does. An emergency stop waits for nothing.
bool CommandTracker::is_due(const OwnerSight& owner, Time now) const {
    const bool is_stop = command_.kind == CommandKind::EmergencyStop;
    if (state_ != State::Sending || (!owner.is_current && !is_stop)) { return false; }
    return !sent_ || now - *sent_ >= (is_stop ? kRepeatStopAfter : kRepeatAfter);
}

}  // namespace lockstep
