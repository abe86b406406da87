// How a session requests the writer's lease, keeps it and gives it back.
#include "clients/session/session.hpp"
#include "services/runtime/clock.hpp"

namespace lockstep {
namespace {

using namespace std::chrono_literals;
using std::chrono::nanoseconds;

constexpr nanoseconds kLeasePatience = 3s;

}  // namespace

std::expected<Reply, Failure> Session::take_lease(bool takes_over, const StopSignal* stop) {
    ask_for_lease(takes_over);
    const nanoseconds deadline = running_time() + kLeasePatience;
    while (!lease_.answer()) {
        if (stop != nullptr && stop->requested()) { return std::unexpected(failed("interrupted; nothing was begun")); }
        if (running_time() > deadline) { return std::unexpected(silent()); }
        receive(50ms);
    }
    return *lease_.answer();
}

void Session::ask_for_lease(bool takes_over) {
    lease_.ask(++sequence_, takes_over);
    keep_lease();
}

void Session::keep_lease() {
    if (const auto request = lease_.due(monotonic_now())) { (void)client_bus().commands.write(*request); }
}

void Session::give_lease(nanoseconds patience) {
    const auto command = lease_.give(++sequence_);
    if (!command) { return; }
    (void)client_bus().commands.write(*command);
    (void)receive_until(patience, [this] { return lease_.answer().has_value(); });
}

}  // namespace lockstep
