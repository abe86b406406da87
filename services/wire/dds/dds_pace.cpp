#include "services/wire/dds/dds_pace.hpp"

#include <fmt/format.h>

#include <algorithm>

namespace lockstep {
namespace {

constexpr int kLongestLease_ms = 10'000;
constexpr int kFew = 16;  // up to this number of processes the shortest useful periods apply

int at_least_few(std::size_t processes) { return std::max(kFew, static_cast<int>(processes)); }

/// The factor for the periods, proportional to N^3: N processes answer N^2 requests, and on one host each process waits
/// for N others.
int stretch(std::size_t processes) {
    const int n = at_least_few(processes);
    return n * n * n / (kFew * kFew * kFew);
}

}  // namespace

std::chrono::milliseconds discovery_lease(std::size_t processes) {
    return std::chrono::milliseconds(std::min(1000 * stretch(processes), kLongestLease_ms));
}

// A new process announces itself at once and gets answers at once. The repeats make up for lost messages and keep the
// lease.
std::string discovery_pace(std::size_t processes) {
    const int n = at_least_few(processes);
    const int announced_ms = std::min(200 * n * n / (kFew * kFew), kLongestLease_ms / 5);
    return fmt::format("<SPDPInterval>{} ms</SPDPInterval><LeaseDuration>{} ms</LeaseDuration>", announced_ms,
                       discovery_lease(processes).count());
}

// A reader must request a lost setpoint at once (NackDelay 0; the default of 100 ms would cost ten slots), and must
// soon notice the loss of the last one (heartbeats of 2 to 20 ms).
std::string repair_pace(std::size_t processes) {
    const int s = stretch(processes);
    return fmt::format(
        "<HeartbeatInterval min=\"{} ms\" minsched=\"{} ms\" max=\"{} ms\">{} ms</HeartbeatInterval>"
        "<NackDelay>{} ms</NackDelay><AckDelay>{} ms</AckDelay>"
        "<PreEmptiveAckDelay>{} ms</PreEmptiveAckDelay>"
        "<AutoReschedNackDelay>{} ms</AutoReschedNackDelay>",
        s, s, 20 * s, 2 * s, s - 1, s, s, 2 * s);
}

}  // namespace lockstep
