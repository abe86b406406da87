#include "clients/doctor/probes.hpp"

#include <fmt/format.h>
#include <ifaddrs.h>
#include <net/if.h>
#include <sched.h>
#include <sys/mman.h>
#include <sys/resource.h>
#include <sys/socket.h>
#include <sys/statvfs.h>
#include <sys/timex.h>
#include <unistd.h>
#include <lcm/lcm-cpp.hpp>

#include <algorithm>
#include <cerrno>
#include <cstring>
#include <ctime>
#include <filesystem>
#include <fstream>
#include <memory>
#include <thread>
#include <vector>

#include "core/if_positive.hpp"
#include "services/files/descriptor.hpp"
#include "services/runtime/clock.hpp"

namespace lockstep::doctor {
namespace {

using std::chrono::nanoseconds;

std::string cause() { return std::strerror(errno); }

/// Uses a separate thread, so that the granted scheduling ends with that thread.
std::string try_scheduler() {
    std::string why;
    std::jthread([&] {
        const sched_param wanted{.sched_priority = 1};
        if (sched_setscheduler(0, SCHED_FIFO, &wanted) != 0) { why = cause(); }
    }).join();
    return why;
}

std::string try_memory() {
    rlimit limit{};
    (void)getrlimit(RLIMIT_MEMLOCK, &limit);
    if (geteuid() == 0 || limit.rlim_cur == RLIM_INFINITY) { return ""; }
    return fmt::format("the limit is {} KB", limit.rlim_cur / 1024);
}

int buffer_given(int option, std::int64_t asked) {
    const Descriptor socket(::socket(AF_INET, SOCK_DGRAM | SOCK_CLOEXEC, 0));
    const int wanted = static_cast<int>(asked);
    int given = 0;
    socklen_t size = sizeof given;
    (void)::setsockopt(socket.get(), SOL_SOCKET, option, &wanted, sizeof wanted);
    (void)::getsockopt(socket.get(), SOL_SOCKET, option, &given, &size);
    return given;
}

}  // namespace

InterfaceFacts look_at_interface(const std::string& name) {
    ifaddrs* all = nullptr;
    if (getifaddrs(&all) != 0) { return {}; }
    const std::unique_ptr<ifaddrs, void (*)(ifaddrs*)> owner(all, freeifaddrs);
    InterfaceFacts facts;
    for (const ifaddrs* each = all; each != nullptr; each = each->ifa_next) {
        if (name != each->ifa_name) { continue; }
        facts.exists = true;
        facts.up = (each->ifa_flags & IFF_UP) != 0;
        facts.multicast = (each->ifa_flags & IFF_MULTICAST) != 0;
        facts.has_address = facts.has_address || (each->ifa_addr != nullptr && each->ifa_addr->sa_family == AF_INET);
    }
    return facts;
}

std::int64_t receive_buffer_given(std::int64_t asked) {
    return buffer_given(SO_RCVBUF, asked) / 2;  // the kernel doubles the size for its own use
}

std::int64_t send_buffer_given(std::int64_t asked) { return buffer_given(SO_SNDBUF, asked); }

std::optional<bool> receives_own_message(const std::string& lcm_url) {
    lcm::LCM lcm(lcm_url);
    if (!lcm.good()) { return std::nullopt; }
    const std::string channel = fmt::format("LOCKSTEP_DOCTOR_{}", getpid());
    bool received = false;
    lcm.subscribeFunction(
        channel, +[](const lcm::ReceiveBuffer*, const std::string&, bool* done) { *done = true; }, &received);
    constexpr int kTries = 5;
    constexpr int kPatience_ms = 200;
    for (int tries = 0; tries < kTries && !received; ++tries) {
        const char nothing = 0;
        (void)lcm.publish(channel, &nothing, 1);
        (void)lcm.handleTimeout(kPatience_ms);
    }
    return received;
}

RealTimeFacts look_at_real_time() { return {.scheduler = try_scheduler(), .memory = try_memory()}; }

ClockFacts look_at_clock() {
    ClockFacts facts;
    std::ifstream("/sys/devices/system/clocksource/clocksource0/current_clocksource") >> facts.source;
    timex state{};
    facts.synchronised = adjtimex(&state) != TIME_ERROR;
    facts.tai_offset_s = if_positive(state.tai);
    return facts;
}

StallFacts look_for_stalls(nanoseconds period, nanoseconds during, const std::function<void(double)>& progress) {
    std::vector<double> late_us;
    const nanoseconds begun = monotonic_now();
    for (nanoseconds next = begun + period; next < begun + during; next += period) {
        const timespec wake = to_timespec(next);
        while (clock_nanosleep(CLOCK_MONOTONIC, TIMER_ABSTIME, &wake, nullptr) == EINTR) {}
        late_us.push_back(static_cast<double>((monotonic_now() - next).count()) * 1e-3);
        progress(static_cast<double>((next - begun).count()) / static_cast<double>(during.count()));
    }
    if (late_us.empty()) { return {}; }
    std::ranges::sort(late_us);
    return {.worst_us = late_us.back(),
            .p99_us = late_us[late_us.size() * 99 / 100],
            .seconds = static_cast<double>(during.count()) * 1e-9};
}

std::string why_not_writable(const std::string& directory) {
    std::filesystem::path path = directory;
    std::error_code error;
    while (!std::filesystem::exists(path, error) && path.has_relative_path()) { path = path.parent_path(); }
    if (!std::filesystem::is_directory(path, error)) { return path.string() + ": is not a directory"; }
    if (access(path.c_str(), W_OK | X_OK) != 0) { return path.string() + ": " + cause(); }
    struct statvfs disk {};
    const bool is_full = statvfs(path.c_str(), &disk) == 0 && disk.f_bavail == 0;
    return is_full ? path.string() + ": no space is left on its disk" : "";
}

}  // namespace lockstep::doctor
