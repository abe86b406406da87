// Sums and products of 128 bits from words of 64: a 32-bit processor's compiler has no such type.
#pragma once

#include <cstdint>

namespace lockstep::firmware {

/// Two's complement: high x 2^64 + low.
struct Wide {
    std::uint64_t high = 0;
    std::uint64_t low = 0;
};

constexpr Wide widened(std::int64_t value) {
    return {.high = value < 0 ? ~std::uint64_t{0} : 0, .low = static_cast<std::uint64_t>(value)};
}

constexpr Wide operator+(Wide one, Wide other) {
    const std::uint64_t low = one.low + other.low;
    return {.high = one.high + other.high + (low < one.low ? 1 : 0), .low = low};
}

constexpr Wide operator-(Wide value) {
    return Wide{.high = ~value.high, .low = ~value.low} + Wide{.high = 0, .low = 1};
}

constexpr bool is_negative(Wide value) { return value.high >> 63 != 0; }

/// Whether the value is one of 64 bits with a sign.
constexpr bool is_narrow(Wide value) { return value.high == widened(static_cast<std::int64_t>(value.low)).high; }

/// (a1 2^32 + a0)(b1 2^32 + b0), each product of halves with its carry.
constexpr Wide product(std::uint64_t a, std::uint64_t b) {
    constexpr std::uint64_t kHalf = 0xFFFF'FFFF;
    const std::uint64_t low = (a & kHalf) * (b & kHalf);
    const std::uint64_t cross = (a >> 32) * (b & kHalf) + (low >> 32);
    const std::uint64_t other = (a & kHalf) * (b >> 32) + (cross & kHalf);
    return {.high = (a >> 32) * (b >> 32) + (cross >> 32) + (other >> 32), .low = other << 32 | (low & kHalf)};
}

/// times: 0 or more.
constexpr Wide product_of(std::int64_t value, std::int64_t times) {
    const auto size = static_cast<std::uint64_t>(value);
    const auto count = static_cast<std::uint64_t>(times);
    return value < 0 ? -product(0 - size, count) : product(size, count);
}

}  // namespace lockstep::firmware
