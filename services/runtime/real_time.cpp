#include "services/runtime/real_time.hpp"

#include <fmt/format.h>
#include <malloc.h>
#include <sched.h>
#include <sys/mman.h>
#include <sys/resource.h>
#include <unistd.h>

#include <cerrno>
#include <cstring>
#include <memory>

namespace lockstep {
namespace {

constexpr std::size_t kHeap_bytes = 16U << 20U;  // more than a service's loop ever uses at a time

std::string cause() { return std::string(" (") + std::strerror(errno) + ")"; }

std::string ask_for_scheduler(int priority) {
    const sched_param wanted{.sched_priority = priority};
    if (sched_setscheduler(0, SCHED_FIFO, &wanted) == 0) {
        return fmt::format("scheduler FIFO, priority {}", priority);
    }
    return "scheduler normal: FIFO was refused" + cause() +
           "; a busy host may stall this process, and a stall longer than timing.stall_slots brings the machine "
           "to "
           "rest; to allow it: LimitRTPRIO=99 in the unit, or --ulimit rtprio=99 --cap-add SYS_NICE for a container";
}

std::string ask_for_cpus(const std::vector<int>& cpus) {
    cpu_set_t set;
    CPU_ZERO(&set);
    for (const int cpu : cpus) { CPU_SET(static_cast<std::size_t>(cpu), &set); }
    const std::string names = fmt::format("{}", fmt::join(cpus, " "));
    if (sched_setaffinity(0, sizeof set, &set) == 0) { return "runs on processors " + names; }
    const std::string why = cause();
    return fmt::format("runs on any processor: {} was refused{}; this host has processors 0 to {} (real_time.cpus)",
                       names, why, sysconf(_SC_NPROCESSORS_CONF) - 1);
}

/// Makes the process keep freed memory, and touches the heap once, so that the loop causes no page faults.
void touch_heap() {
    mallopt(M_TRIM_THRESHOLD, -1);
    mallopt(M_MMAP_MAX, 0);
    const auto heap = std::make_unique_for_overwrite<char[]>(kHeap_bytes);
    volatile char* const bytes = heap.get();
    for (std::size_t i = 0; i < kHeap_bytes; i += 4096) { bytes[i] = 0; }
}

/// With a limit on locked memory, a later mapping beyond the limit would fail, so then nothing is locked.
bool may_lock_all() {
    rlimit limit{};
    return geteuid() == 0 || (getrlimit(RLIMIT_MEMLOCK, &limit) == 0 && limit.rlim_cur == RLIM_INFINITY);
}

std::string lock_memory() {
    if (!may_lock_all()) { errno = EPERM; }
    if (may_lock_all() && mlockall(MCL_CURRENT | MCL_FUTURE) == 0) {
        touch_heap();
        return "memory locked";
    }
    return "memory not locked" + cause() +
           "; a page that is swapped out stalls this process; to allow it: LimitMEMLOCK=infinity in the unit, or "
           "--ulimit memlock=-1 for a container";
}

}  // namespace

std::vector<std::string> ask_for_real_time(const RealTimeConfig& wanted) {
    std::vector<std::string> lines;
    if (!wanted.cpus.empty()) { lines.push_back(ask_for_cpus(wanted.cpus)); }
    if (wanted.priority == 0) { return lines; }
    lines.push_back(ask_for_scheduler(wanted.priority));
    lines.push_back(lock_memory());
    return lines;
}

void leave_real_time() {
    const sched_param normal{.sched_priority = 0};
    (void)sched_setscheduler(0, SCHED_OTHER, &normal);
}

}  // namespace lockstep
