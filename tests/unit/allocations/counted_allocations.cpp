#include "tests/unit/allocations/counted_allocations.hpp"

#include <execinfo.h>

#include <array>
#include <cstdlib>
#include <new>
#include <sstream>

namespace {

constexpr std::size_t kPlacesKept = 20;
constexpr std::size_t kDepth = 16;

struct Place {
    std::array<void*, kDepth> calls{};
    int depth = 0;
};

thread_local bool g_counts = false;
thread_local std::uint64_t g_count = 0;
thread_local std::array<Place, kPlacesKept> g_places{};

void note_allocation() {
    g_counts = false;  // backtrace() may allocate
    if (g_count < kPlacesKept) {
        Place& place = g_places[g_count];
        place.depth = backtrace(place.calls.data(), kDepth);
    }
    ++g_count;
    g_counts = true;
}

void* allocate(std::size_t bytes) {
    if (g_counts) { note_allocation(); }
    if (void* const memory = std::malloc(bytes)) { return memory; }
    throw std::bad_alloc();
}

void* allocate(std::size_t bytes, std::align_val_t alignment) {
    if (g_counts) { note_allocation(); }
    const auto multiple = static_cast<std::size_t>(alignment);
    if (void* const memory = std::aligned_alloc(multiple, (bytes + multiple - 1) / multiple * multiple)) {
        return memory;
    }
    throw std::bad_alloc();
}

}  // namespace

// NOLINTBEGIN(misc-new-delete-overloads): only test programs use them
void* operator new(std::size_t bytes) { return allocate(bytes); }
void* operator new[](std::size_t bytes) { return allocate(bytes); }
void* operator new(std::size_t bytes, std::align_val_t alignment) { return allocate(bytes, alignment); }
void* operator new[](std::size_t bytes, std::align_val_t alignment) { return allocate(bytes, alignment); }
void operator delete(void* memory) noexcept { std::free(memory); }
void operator delete[](void* memory) noexcept { std::free(memory); }
void operator delete(void* memory, std::size_t /*bytes*/) noexcept { std::free(memory); }
void operator delete[](void* memory, std::size_t /*bytes*/) noexcept { std::free(memory); }
void operator delete(void* memory, std::align_val_t /*alignment*/) noexcept { std::free(memory); }
void operator delete[](void* memory, std::align_val_t /*alignment*/) noexcept { std::free(memory); }
void operator delete(void* memory, std::size_t /*bytes*/, std::align_val_t /*alignment*/) noexcept {
    std::free(memory);
}
void operator delete[](void* memory, std::size_t /*bytes*/, std::align_val_t /*alignment*/) noexcept {
    std::free(memory);
}
// NOLINTEND(misc-new-delete-overloads)

namespace lockstep {

CountedAllocations::CountedAllocations(bool counts) { g_counts = counts; }
CountedAllocations::~CountedAllocations() { g_counts = false; }

std::uint64_t CountedAllocations::count() { return g_count; }

std::string CountedAllocations::places() {
    std::ostringstream text;
    for (const Place& place : g_places) {
        for (int k = 0; k < place.depth; ++k) { text << place.calls[static_cast<std::size_t>(k)] << ' '; }
        text << (place.depth > 0 ? "\n" : "");
    }
    return text.str();
}

}  // namespace lockstep
