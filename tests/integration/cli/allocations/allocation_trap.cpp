// A library to load before all others (LD_PRELOAD): counts the allocations of memory in a program's main thread.
#include <dlfcn.h>
#include <execinfo.h>
#include <fcntl.h>
#include <link.h>
#include <sys/mman.h>
#include <unistd.h>

#include <cerrno>
#include <cstdlib>
#include <new>
#include <string>
#include <string_view>

#include "tests/integration/cli/allocations/allocation_count.hpp"

extern "C" {
void* __libc_malloc(std::size_t);
void* __libc_calloc(std::size_t, std::size_t);
void* __libc_realloc(void*, std::size_t);
void* __libc_memalign(std::size_t, std::size_t);
void __libc_free(void*);
}

namespace lockstep {
namespace {

struct Range {
    std::uintptr_t begin = 0;
    std::uintptr_t end = 0;

    bool holds(std::uintptr_t address) const { return address >= begin && address < end; }
};

AllocationCount* count = nullptr;
std::uintptr_t program_begin = 0;
Range program;
std::array<Range, 2> languages;  // the libraries of C++ and C: their caller is counted instead
pid_t main_thread = 0;
thread_local bool is_counting = false;

int note_range(dl_phdr_info* info, std::size_t, void*) {
    Range range{~std::uintptr_t{0}, 0};
    for (int i = 0; i < info->dlpi_phnum; ++i) {
        if (info->dlpi_phdr[i].p_type != PT_LOAD) { continue; }
        const std::uintptr_t begin = info->dlpi_addr + info->dlpi_phdr[i].p_vaddr;
        range.begin = std::min(range.begin, begin);
        range.end = std::max(range.end, begin + info->dlpi_phdr[i].p_memsz);
    }
    const std::string_view name = info->dlpi_name;
    if (name.empty() && program.end == 0) {
        program = range;
        program_begin = info->dlpi_addr;
    }
    if (name.find("/libstdc++.so") != name.npos) { languages[0] = range; }
    if (name.find("/libc.so") != name.npos) { languages[1] = range; }
    return 0;
}

__attribute__((constructor)) void begin() {
    std::array<void*, 4> frames{};
    backtrace(frames.data(), frames.size());  // its first call allocates
    const char* directory = std::getenv(kAllocationDirectory);
    if (directory == nullptr) { return; }
    const std::string name = std::string(directory) + "/" + std::to_string(getpid());
    const int file = open(name.c_str(), O_RDWR | O_CREAT | O_CLOEXEC, 0600);
    if (file < 0 || ftruncate(file, sizeof(AllocationCount)) != 0) { return; }
    void* memory = mmap(nullptr, sizeof(AllocationCount), PROT_READ | PROT_WRITE, MAP_SHARED, file, 0);
    close(file);
    if (memory == MAP_FAILED) { return; }
    dl_iterate_phdr(note_range, nullptr);
    main_thread = getpid();
    count = static_cast<AllocationCount*>(memory);
}

bool is_language(std::uintptr_t address) { return languages[0].holds(address) || languages[1].holds(address); }

/// The nearest caller that is in neither library of the language.
std::uintptr_t caller_behind(std::uintptr_t nearest) {
    if (!is_language(nearest)) { return nearest; }
    std::array<void*, 24> frames{};
    const int found = backtrace(frames.data(), frames.size());
    for (int i = 3; i < found; ++i) {  // behind this function, note() and the allocator
        const auto address = reinterpret_cast<std::uintptr_t>(frames[static_cast<std::size_t>(i)]);
        if (!is_language(address)) { return address; }
    }
    return nearest;
}

void note_place(std::uint64_t address) {
    for (AllocationCount::Place& place : count->places) {
        std::uint64_t free = 0;
        if (place.address != address && !place.address.compare_exchange_strong(free, address)) { continue; }
        ++place.calls;
        return;
    }
}

__attribute__((noinline)) void note(void* nearest) {
    if (count == nullptr || is_counting || gettid() != main_thread) { return; }
    is_counting = true;
    const std::uintptr_t caller = caller_behind(reinterpret_cast<std::uintptr_t>(nearest));
    if (program.holds(caller)) {
        ++count->own;
        note_place(caller - program_begin);
    } else {
        ++count->other;
    }
    is_counting = false;
}

}  // namespace
}  // namespace lockstep

extern "C" {
void* malloc(std::size_t bytes) {
    lockstep::note(__builtin_return_address(0));
    return __libc_malloc(bytes);
}
void* calloc(std::size_t items, std::size_t bytes) {
    lockstep::note(__builtin_return_address(0));
    return __libc_calloc(items, bytes);
}
void* realloc(void* block, std::size_t bytes) {
    lockstep::note(__builtin_return_address(0));
    return __libc_realloc(block, bytes);
}
void* aligned_alloc(std::size_t alignment, std::size_t bytes) {
    lockstep::note(__builtin_return_address(0));
    return __libc_memalign(alignment, bytes);
}
int posix_memalign(void** block, std::size_t alignment, std::size_t bytes) {
    lockstep::note(__builtin_return_address(0));
    *block = __libc_memalign(alignment, bytes);
    return *block == nullptr ? ENOMEM : 0;
}
}

void* operator new(std::size_t bytes) {
    lockstep::note(__builtin_return_address(0));
    void* block = __libc_malloc(bytes);
    if (block == nullptr) { throw std::bad_alloc(); }
    return block;
}
void* operator new(std::size_t bytes, std::align_val_t alignment) {
    lockstep::note(__builtin_return_address(0));
    void* block = __libc_memalign(static_cast<std::size_t>(alignment), bytes);
    if (block == nullptr) { throw std::bad_alloc(); }
    return block;
}
void operator delete(void* block) noexcept { __libc_free(block); }
void operator delete(void* block, std::size_t) noexcept { __libc_free(block); }
void operator delete(void* block, std::align_val_t) noexcept { __libc_free(block); }
void operator delete(void* block, std::size_t, std::align_val_t) noexcept { __libc_free(block); }
