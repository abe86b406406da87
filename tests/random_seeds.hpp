// The seeds of a property's random cases. make test runs a third of them. make test-long, which sets
// LOCKSTEP_LONG_TESTS, runs all.
#pragma once

#include <gtest/gtest.h>

#include <cstdint>
#include <cstdlib>

namespace lockstep {

inline std::uint64_t random_cases(std::uint64_t all) {
    constexpr std::uint64_t kOneOf = 3;
    return std::getenv("LOCKSTEP_LONG_TESTS") != nullptr ? all : (all + kOneOf - 1) / kOneOf;
}

/// Consecutive seeds from `first` on, for INSTANTIATE_TEST_SUITE_P.
inline auto seeds_from(std::uint64_t first, std::uint64_t all) {
    return testing::Range(first, first + random_cases(all));
}

}  // namespace lockstep
