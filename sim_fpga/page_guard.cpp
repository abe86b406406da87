#include "sim_fpga/page_guard.hpp"

#include <sys/mman.h>

#include <array>
#include <atomic>
#include <csignal>

namespace lockstep {
namespace {

constexpr std::uintptr_t kFree = 0;
constexpr std::uintptr_t kClaimed = 1;  // its size is being written

struct Range {
    std::atomic<std::uintptr_t> begin{kFree};
    std::atomic<std::size_t> bytes{0};
};
static_assert(std::atomic<std::uintptr_t>::is_always_lock_free, "a signal handler may only use lock-free atomics");

std::array<Range, PageGuard::kMost> ranges;

bool replace(std::uintptr_t begin, std::size_t bytes) {
    void* const at = reinterpret_cast<void*>(begin);
    return mmap(at, bytes, PROT_READ | PROT_WRITE, MAP_PRIVATE | MAP_ANONYMOUS | MAP_FIXED, -1, 0) == at;
}

extern "C" void on_missing_page(int, siginfo_t* info, void*) {
    const auto address = reinterpret_cast<std::uintptr_t>(info->si_addr);
    for (const Range& range : ranges) {
        const std::uintptr_t begin = range.begin.load(std::memory_order_acquire);
        const std::size_t bytes = range.bytes.load(std::memory_order_relaxed);
        const bool is_in = begin > kClaimed && address >= begin && address - begin < bytes;
        if (is_in && replace(begin, bytes)) { return; }
    }
    std::signal(SIGBUS, SIG_DFL);  // the access is tried again, and ends the process
}

bool install() {
    struct sigaction action {};
    action.sa_sigaction = on_missing_page;
    action.sa_flags = SA_SIGINFO;
    sigemptyset(&action.sa_mask);
    return sigaction(SIGBUS, &action, nullptr) == 0;
}

}  // namespace

PageGuard::PageGuard(void* begin, std::size_t bytes) {
    [[maybe_unused]] static const bool installed = install();
    for (place_ = 0; place_ < kMost; ++place_) {
        std::uintptr_t expected = kFree;
        if (!ranges[place_].begin.compare_exchange_strong(expected, kClaimed)) { continue; }
        ranges[place_].bytes.store(bytes, std::memory_order_relaxed);
        ranges[place_].begin.store(reinterpret_cast<std::uintptr_t>(begin), std::memory_order_release);
        return;
    }
}

PageGuard::~PageGuard() {
    if (place_ < kMost) { ranges[place_].begin.store(kFree, std::memory_order_release); }
}

}  // namespace lockstep
