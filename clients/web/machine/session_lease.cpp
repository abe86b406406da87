#include "clients/web/machine/session_lease.hpp"

#include <algorithm>

#include "clients/web/state/writer_document.hpp"
#include "services/network/host_name.hpp"

namespace lockstep::web {
namespace {

using namespace std::chrono_literals;

/// Converts to this host's clock, because machine time has no date.
std::chrono::system_clock::time_point time_of(Tick tick, const MachineState& state, const MachineConfig& machine) {
    const auto ago_ns = static_cast<std::int64_t>(machine.microseconds(state.tick - tick) * 1e3);
    const auto time = std::chrono::system_clock::now() - nanoseconds(std::max<std::int64_t>(0, ago_ns));
    return std::chrono::time_point_cast<std::chrono::system_clock::duration>(time);
}

}  // namespace

SessionLease::SessionLease(Session& session, const std::string& name) : session_(session) {
    session_.write_as({.name = name, .host = host_name()});
}

void SessionLease::pass(const WriterTurn::Use& use, nanoseconds now) {
    const auto& answer = session_.lease_reply();
    switch (turn_.pass({session_.holds_lease(), answer ? &*answer : nullptr}, use, now)) {
        case WriterTurn::Send::Nothing: break;
        case WriterTurn::Send::Ask: session_.ask_for_lease(); break;
        case WriterTurn::Send::TakeOver: session_.ask_for_lease(true); break;
        case WriterTurn::Send::Give: session_.give_lease(); break;
    }
    note_writer();
}

void SessionLease::end() { session_.give_lease(300ms); }

std::optional<Problem> SessionLease::refusal(bool takes_over) const {
    const auto& answer = session_.lease_reply();
    if (!turn_.is_refused(takes_over) || !answer) { return std::nullopt; }
    Problem problem = refused(answer->fault, answer->text);
    if (writer_ && !writer_->is_this_server) { problem.value = writer_json(*writer_); }
    return problem;
}

void SessionLease::note_writer() {
    const HeldLease* lease = session_.writer();
    if (lease == nullptr) {
        seen_.reset();
        writer_.reset();
        return;
    }
    if (seen_ == *lease) { return; }
    seen_ = *lease;
    writer_ = Writer{.name = lease->writer.name,
                     .host = lease->writer.host,
                     .since = time_of(lease->since, session_.state()->state, session_.config()),
                     .is_this_server = lease->writer.id == session_.writer_id()};
}

}  // namespace lockstep::web
