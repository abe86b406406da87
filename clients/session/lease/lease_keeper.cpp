#include "clients/session/lease/lease_keeper.hpp"

#include <utility>

namespace lockstep {

void LeaseKeeper::write_as(LeaseHolder writer) {
    writer_ = std::move(writer);
    if (writer_.id == 0) { writer_.id = client_; }
}

Command LeaseKeeper::command(std::uint64_t sequence, CommandKind kind) const {
    return {.client = client_, .sequence = sequence, .kind = kind, .writer = writer_};
}

void LeaseKeeper::ask(std::uint64_t sequence, bool takes_over) {
    is_asked_ = true;
    takes_over_ = takes_over;
    sequence_ = sequence;
    answer_.reset();
    sent_.reset();
}

std::optional<Command> LeaseKeeper::give(std::uint64_t sequence) {
    if (!std::exchange(is_asked_, false)) { return std::nullopt; }
    sequence_ = sequence;
    answer_.reset();
    return command(sequence, CommandKind::GiveLease);
}

/// A request takes the lease from another writer only until the first answer, so that a client that loses it does not
/// take it back.
std::optional<Command> LeaseKeeper::due(std::chrono::nanoseconds now) {
    const auto period = answer_ ? std::chrono::milliseconds{kKeepLease_ms} : kAskAgainAfter;
    if (!is_asked_ || (sent_ && now - *sent_ < period)) { return std::nullopt; }
    sent_ = now;
    Command request = command(sequence_, CommandKind::TakeLease);
    request.takes_over = takes_over_ && !answer_;
    return request;
}

bool LeaseKeeper::take_answer(const Reply& reply) {
    if (sequence_ == 0 || reply.sequence != sequence_) { return false; }
    answer_ = reply;
    if (reply.status == ReplyStatus::Refused) { is_asked_ = false; }
    return true;
}

}  // namespace lockstep
