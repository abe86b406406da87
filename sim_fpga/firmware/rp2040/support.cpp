// What the compiler expects of a library: memory, 64-bit products and shifts (Run-time ABI for the Arm Architecture).
#include <cstddef>
#include <cstdint>

namespace {

constexpr std::uint64_t joined(std::uint32_t high, std::uint32_t low) { return std::uint64_t{high} << 32 | low; }
constexpr std::uint32_t high_of(std::uint64_t value) { return static_cast<std::uint32_t>(value >> 32); }
constexpr std::uint32_t low_of(std::uint64_t value) { return static_cast<std::uint32_t>(value); }
constexpr std::uint32_t kHalf = 0xFFFF;

}  // namespace

extern "C" {

void* memcpy(void* to, const void* from, std::size_t size) {
    auto* out = static_cast<std::uint8_t*>(to);
    const auto* in = static_cast<const std::uint8_t*>(from);
    while (size-- > 0) { *out++ = *in++; }
    return to;
}
void* memset(void* to, int value, std::size_t size) {
    auto* out = static_cast<std::uint8_t*>(to);
    while (size-- > 0) { *out++ = static_cast<std::uint8_t>(value); }
    return to;
}
void __aeabi_memcpy(void* to, const void* from, std::size_t size) { memcpy(to, from, size); }
void __aeabi_memcpy4(void* to, const void* from, std::size_t size) {
    auto* out = static_cast<std::uint32_t*>(to);
    const auto* in = static_cast<const std::uint32_t*>(from);
    for (; size >= 4; size -= 4) { *out++ = *in++; }
    if (size > 0) { memcpy(out, in, size); }
}
void __aeabi_memcpy8(void* to, const void* from, std::size_t size) { __aeabi_memcpy4(to, from, size); }
void __aeabi_memset(void* to, std::size_t size, int value) { memset(to, value, size); }
void __aeabi_memset4(void* to, std::size_t size, int value) { memset(to, value, size); }
void __aeabi_memset8(void* to, std::size_t size, int value) { memset(to, value, size); }
void __aeabi_memclr(void* to, std::size_t size) { memset(to, 0, size); }
void __aeabi_memclr4(void* to, std::size_t size) {
    auto* out = static_cast<std::uint32_t*>(to);
    for (; size >= 4; size -= 4) { *out++ = 0; }
    memset(out, 0, size);
}
void __aeabi_memclr8(void* to, std::size_t size) { __aeabi_memclr4(to, size); }

/// The product of the low words by halves, and the products of each low word with the other's high word.
std::uint64_t __aeabi_lmul(std::uint64_t one, std::uint64_t other) {
    const std::uint32_t a = low_of(one);
    const std::uint32_t b = low_of(other);
    const std::uint32_t lowest = (a & kHalf) * (b & kHalf);
    const std::uint32_t cross = (a >> 16) * (b & kHalf) + (lowest >> 16);
    const std::uint32_t middle = (a & kHalf) * (b >> 16) + (cross & kHalf);
    const std::uint32_t high = (a >> 16) * (b >> 16) + (cross >> 16) + (middle >> 16);
    return joined(high + a * high_of(other) + b * high_of(one), middle << 16 | (lowest & kHalf));
}

std::uint64_t __aeabi_llsl(std::uint64_t value, int by) {
    if (by == 0) { return value; }
    if (by >= 32) { return joined(low_of(value) << (by - 32), 0); }
    return joined(high_of(value) << by | low_of(value) >> (32 - by), low_of(value) << by);
}
std::uint64_t __aeabi_llsr(std::uint64_t value, int by) {
    if (by == 0) { return value; }
    if (by >= 32) { return joined(0, high_of(value) >> (by - 32)); }
    return joined(high_of(value) >> by, low_of(value) >> by | high_of(value) << (32 - by));
}

void __cxa_pure_virtual() { __builtin_trap(); }
}
