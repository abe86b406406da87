#include "clients/web/machine/session_lease.hpp"

#include <algorithm>

#include "clients/session/waits.hpp"
#include "clients/web/state/writer_document.hpp"
#include "services/network/host_name.hpp"

namespace lockstep::web {
namespace {

/// Converts to this host's clock, because machine time has no date.
std::chrono::system_clock::time_point time_of(Tick tick, const MachineState& state, const MachineConfig& machine) {
    const auto ago_ns = static_cast<std::int64_t>(machine.microseconds(state.tick - tick) * 1e3);
    const auto time = std::chrono::system_clock::now() - nanoseconds(std::max<std::int64_t>(0, ago_ns));
    return std::chrono::time_point_cast<std::chrono::system_clock::duration>(time);
}

}  // namespace

std::string silence_of(const Session& session) { return silence(session).errors.front().message; }

SessionLease::SessionLease(Session& session, const std::string& name) : session_(session) {
    session_.lease().write_as({.name = name, .host = host_name()});
}

std::optional<Problem> SessionLease::refusal(bool takes_over) const {
    const LeaseKeeper& lease = session_.lease();
    if (lease.state() == LeaseKeeper::State::Unanswered) { return unanswered(silence_of(session_)); }
    if (!lease.is_refused(takes_over)) { return std::nullopt; }
    Problem problem = refused(lease.answer()->fault, lease.answer()->text);
    if (writer_ && !writer_->is_this_server) { problem.value = writer_json(*writer_); }
    return problem;
}

void SessionLease::see() {
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
                     .is_this_server = lease->writer.id == session_.lease().writer().id};
}

}  // namespace lockstep::web
