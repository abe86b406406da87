#include "services/wire/dds/dds_pace.hpp"

#include <fmt/format.h>

#include <algorithm>

namespace lockstep {
namespace {

constexpr int kLongestLease_ms = 10'000;
constexpr int kFew = 16;  // processes up to which every period is as short as useful

int at_least_few(std::size_t processes) { return std::max(kFew, static_cast<int>(processes)); }

/// The factor of the periods: N^2 requests must be answered, and on one host each process waits for N others.
int stretch(std::size_t processes) {
    const int n = at_least_few(processes);
    return n * n * n / (kFew * kFew * kFew);
}

}  // namespace

std::chrono::milliseconds discovery_lease(std::size_t processes) {
    return std::chrono::milliseconds(std::min(1000 * stretch(processes), kLongestLease_ms));
}

// A new process announces itself at once and is answered at once; repeats serve lost messages and the lease.
std::string discovery_pace(std::size_t processes) {
    const int n = at_least_few(processes);
    const int announced_ms = std::min(200 * n * n / (kFew * kFew), kLongestLease_ms / 5);
    return fmt::format("<SPDPInterval>{} ms</SPDPInterval><LeaseDuration>{} ms</LeaseDuration>", announced_ms,
                       discovery_lease(processes).count());
}

// A lost setpoint must be requested at once (NackDelay 0; the default 100 ms would cost ten slots), and the loss of the
// last one must be noticed soon (heartbeats of 2 to 20 ms).
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
