#include "clients/web/machine/writer_turn.hpp"

namespace lockstep::web {

/// A refusal holds for one loop: a later command asks for the lease again.
void WriterTurn::note(const Lease& lease) {
    if (state_ == State::Refused) { state_ = State::Free; }
    if (state_ == State::Held && !lease.is_held) { state_ = State::Free; }
    if (state_ != State::Asked || lease.answer == nullptr) { return; }
    state_ = lease.answer->status == ReplyStatus::Accepted ? State::Held : State::Refused;
}

WriterTurn::Send WriterTurn::ask(bool takes_over) {
    state_ = State::Asked;
    takes_over_ = takes_over;
    return takes_over ? Send::TakeOver : Send::Ask;
}

bool WriterTurn::is_over(const Use& use, Time now) const {
    if (gives_) { return true; }
    if (state_ == State::Asked) { return !use.wants; }  // nobody waits for the answer any more
    return now - used_ > kGiveLeaseAfter;
}

WriterTurn::Send WriterTurn::pass(const Lease& lease, const Use& use, Time now) {
    if (use.wants || use.has_work) { used_ = now; }
    note(lease);
    const bool may_give = state_ == State::Asked || state_ == State::Held;
    if (may_give && is_over(use, now)) {
        gives_ = false;
        state_ = State::Free;
        return Send::Give;
    }
    gives_ = false;
    const bool must_ask = state_ == State::Free && use.wants;
    const bool must_take = state_ == State::Asked && use.takes_over && !takes_over_;
    return must_ask || must_take ? ask(use.takes_over) : Send::Nothing;
}

}  // namespace lockstep::web
