// Draws whole numbers that are the same with every standard library.
#pragma once

#include <cstdint>
#include <random>

namespace lockstep {

using Random = std::mt19937_64;

/// From 0 to n - 1.
inline std::int64_t draw_below(Random& random, std::int64_t n) {
    return static_cast<std::int64_t>(random() % static_cast<std::uint64_t>(n));
}
/// True once in n times.
inline bool one_in(Random& random, std::int64_t n) { return draw_below(random, n) == 0; }

}  // namespace lockstep
