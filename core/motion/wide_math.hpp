// Exact products and quotients wider than the machine's words.
#pragma once

#include "core/units.hpp"

namespace lockstep {

/// floor(value * factor / divisor) without overflow. value >= 0, 0 <= factor < 2^62, 0 < divisor < 2^62; the
/// result must fit in 127 bits. The remainder of each half is carried into the next, as in long division.
constexpr Int128 mul_div(Int128 value, std::int64_t factor, std::int64_t divisor) {
    const auto high = static_cast<UInt128>(value) >> 64;
    const auto low = static_cast<UInt128>(static_cast<std::uint64_t>(value));
    const auto f = static_cast<UInt128>(factor);
    const auto d = static_cast<UInt128>(divisor);
    const UInt128 upper = high * f;
    const UInt128 lower = ((upper % d) << 64) + low * f;
    return static_cast<Int128>(((upper / d) << 64) + lower / d);
}

/// floor(a / b) for b > 0 and any a.
constexpr Int128 floor_div(Int128 a, Int128 b) { return a >= 0 ? a / b : -((-a + b - 1) / b); }

}  // namespace lockstep
