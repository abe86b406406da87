#include "clients/session/follow/command_tracker.hpp"

#include <algorithm>

namespace lockstep {
namespace {

/// A command that stops motion. It waits for nothing, and the sooner it arrives, the better.
bool stops_at_once(const Command& command) {
    return command.kind == CommandKind::EmergencyStop || (command.kind == CommandKind::Jog && command.jogs.empty());
}

}  // namespace

void CommandTracker::number(Identity client, std::uint64_t sequence, std::uint64_t writer) {
    command_.client = client;
    command_.sequence = sequence;
    command_.writer.id = writer;
}

CommandStep CommandTracker::pass(const Reply* reply, const OwnerSight& owner, Time now) {
    if (state_ == State::GaveUp) { return CommandStep::GaveUp; }
    if (reply != nullptr) { reply_ = *reply; }
    if (reply_ && !period()) { return CommandStep::Answered; }
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
    if (reply_) { return false; }
    const bool may_plan = state_ == State::Sending && command_.program != 0 && !owner.is_silent;
    return now - *begun_ > (may_plan ? Time{kPlanPatience} : patience_);
}

std::optional<CommandTracker::Time> CommandTracker::period() const {
    if (state_ != State::Sending) { return std::nullopt; }
    if (command_.kind == CommandKind::Jog && (!reply_ || !command_.jogs.empty())) { return kRenewJogAfter; }
    if (command_.kind == CommandKind::TakeLease && reply_) { return std::chrono::milliseconds{kKeepLease_ms}; }
    if (reply_) { return std::nullopt; }
    return command_.kind == CommandKind::EmergencyStop ? kRepeatStopAfter : kRepeatAfter;
}

std::optional<CommandTracker::Time> CommandTracker::due_in(Time now) const {
    const auto every = period();
    if (!every) { return std::nullopt; }
    return sent_ ? std::max(Time{}, *sent_ + *every - now) : Time{};
}

/// A client that was itself stopped first looks what the machine does.
bool CommandTracker::is_due(const OwnerSight& owner, Time now) const {
    return due_in(now) == Time{} && (owner.is_current || stops_at_once(command_));
}

}  // namespace lockstep
