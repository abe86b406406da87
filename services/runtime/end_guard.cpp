#include "services/runtime/end_guard.hpp"

#include <poll.h>
#include <unistd.h>

#include <cstdlib>
#include <string_view>

#include "services/runtime/service_options.hpp"
#include "services/runtime/sleep.hpp"

namespace lockstep {
namespace {

constexpr int kLooksAtEnd = 40;
constexpr std::string_view kWhy = "the process did not end in time; a disk may hang; it ends now without waiting\n";

/// Does not use the log, because a thread that hangs may hold the log's lock.
[[noreturn]] void end_at_once() {
    pollfd log{.fd = STDERR_FILENO, .events = POLLOUT, .revents = 0};
    if (poll(&log, 1, 0) == 1) { (void)!write(log.fd, kWhy.data(), kWhy.size()); }
    std::_Exit(kServiceFailed);
}

}  // namespace

EndGuard::EndGuard(const StopSignal& stop, std::chrono::milliseconds longest)
    : between_looks_(longest / kLooksAtEnd),
      thread_([this, &stop](const std::stop_token& ended) { watch(ended, stop); }) {}

void EndGuard::watch(const std::stop_token& ended, const StopSignal& stop) const {
    for (int looks = 0; looks < kLooksAtEnd;) {
        if (!sleep_unless(ended, between_looks_)) { return; }
        looks = stop.requested() ? looks + 1 : 0;
    }
    end_at_once();
}

}  // namespace lockstep
