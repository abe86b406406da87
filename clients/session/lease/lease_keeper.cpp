#include "clients/session/lease/lease_keeper.hpp"

#include <utility>

namespace lockstep {
namespace {

constexpr std::uint64_t kOfLease = std::uint64_t{1} << 62;  // other commands have lower numbers, programs higher ones

}  // namespace

void LeaseKeeper::write_as(LeaseHolder writer) {
    writer_ = std::move(writer);
    if (writer_.id == 0) { writer_.id = client_; }
}

Command LeaseKeeper::next_command(CommandKind kind) {
    sequence_ = kOfLease | ++commands_;
    answer_.reset();
    return {.client = client_, .sequence = sequence_, .kind = kind, .writer = writer_};
}

void LeaseKeeper::use(const LeaseUse& use, Time now) {
    if (use.wants || use.has_work) { used_ = now; }
    const bool is_unwanted = state_ == State::Asked && !use.wants;
    const bool is_unused = state_ == State::Held && now - used_ > kGiveLeaseAfter;
    if (is_unwanted || is_unused) { return give(); }
    const bool is_asked = state_ == State::Asked && takes_over_ >= use.takes_over;
    if (is_held() || is_asked) { return; }
    state_ = State::Free;
    if (use.wants) { ask(use.takes_over); }
}

void LeaseKeeper::ask(bool takes_over) {
    state_ = State::Asked;
    takes_over_ = takes_over;
    Command request = next_command(CommandKind::TakeLease);
    request.takes_over = takes_over;
    request_.emplace(request);
}

void LeaseKeeper::give() {
    if (state_ == State::Asked || state_ == State::Held) { giving_ = next_command(CommandKind::GiveLease); }
    state_ = State::Free;
}

/// A request without an answer is withdrawn: it may reach the coordinator when no command waits for it any more. A
/// request takes the lease from another writer only until the first answer, so that a client that loses it does not
/// take it back.
std::optional<Command> LeaseKeeper::due(const OwnerSight& owner, Time now) {
    if (giving_) { return std::exchange(giving_, std::nullopt); }
    if (state_ != State::Asked && state_ != State::Held) { return std::nullopt; }
    const CommandStep step = request_->pass(answer_ ? &*answer_ : nullptr, owner, now);
    if (step == CommandStep::GaveUp) {
        state_ = State::Unanswered;
        return next_command(CommandKind::GiveLease);
    }
    if (step != CommandStep::Send) { return std::nullopt; }
    Command request = request_->command();
    request.takes_over = request.takes_over && !answer_;
    return request;
}

bool LeaseKeeper::take_answer(const Reply& reply) {
    if (sequence_ == 0 || reply.sequence != sequence_) { return false; }
    answer_ = reply;
    const bool is_accepted = reply.status == ReplyStatus::Accepted;
    if (state_ == State::Held && !is_accepted) { state_ = State::Lost; }
    if (state_ == State::Asked) { state_ = is_accepted ? State::Held : State::Refused; }
    return true;
}

}  // namespace lockstep
