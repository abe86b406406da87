// Numbers that vector units compute at once, for loops that the compiler does not turn into vector instructions itself.
// Operators work on each number; a comparison gives -1 where it is true, else 0.
#pragma once

#include <algorithm>
#include <array>
#include <cstddef>
#include <cstdint>
#include <cstring>

namespace lockstep::analysis {

using IntLanes [[gnu::vector_size(64)]] = std::int32_t;      // 16
using HalfIntLanes [[gnu::vector_size(32)]] = std::int32_t;  // 8
using FloatLanes [[gnu::vector_size(64)]] = float;           // 16
using DoubleLanes [[gnu::vector_size(64)]] = double;         // 8
using LongLanes [[gnu::vector_size(64)]] = std::int64_t;     // 8

template <typename Lanes, typename Number>
[[gnu::always_inline]] inline void load(Lanes& lanes, const Number* from) {
    std::memcpy(&lanes, from, sizeof lanes);
}
template <typename Lanes, typename Number>
[[gnu::always_inline]] inline void store(const Lanes& lanes, Number* to) {
    std::memcpy(static_cast<void*>(to), &lanes, sizeof lanes);
}

/// Divides as doubles.
[[gnu::always_inline]] inline void divide(const HalfIntLanes& a, const HalfIntLanes& b, DoubleLanes& quotient) {
    quotient = __builtin_convertvector(a, DoubleLanes) / __builtin_convertvector(b, DoubleLanes);
}

/// Numbers of both, one after the other, as floats.
[[gnu::always_inline]] inline void by_turns(const DoubleLanes& a, const DoubleLanes& b, FloatLanes& to) {
    using HalfFloatLanes [[gnu::vector_size(32)]] = float;
    const HalfFloatLanes first = __builtin_convertvector(a, HalfFloatLanes);
    const HalfFloatLanes second = __builtin_convertvector(b, HalfFloatLanes);
    to = __builtin_shufflevector(first, second, 0, 8, 1, 9, 2, 10, 3, 11, 4, 12, 5, 13, 6, 14, 7, 15);
}

/// Replaces each number by the sum of the numbers up to it.
[[gnu::always_inline]] inline void sum_up(IntLanes& sums) {
    const IntLanes none{};
    sums += __builtin_shufflevector(sums, none, 16, 0, 1, 2, 3, 4, 5, 6, 7, 8, 9, 10, 11, 12, 13, 14);
    sums += __builtin_shufflevector(sums, none, 16, 16, 0, 1, 2, 3, 4, 5, 6, 7, 8, 9, 10, 11, 12, 13);
    sums += __builtin_shufflevector(sums, none, 16, 16, 16, 16, 0, 1, 2, 3, 4, 5, 6, 7, 8, 9, 10, 11);
    sums += __builtin_shufflevector(sums, none, 16, 16, 16, 16, 16, 16, 16, 16, 0, 1, 2, 3, 4, 5, 6, 7);
}

/// Whether all results of a comparison are true.
template <typename Lanes>
[[gnu::always_inline]] inline bool all_true(const Lanes& results) {
    LongLanes all;
    static_assert(sizeof all == sizeof results);
    std::memcpy(&all, &results, sizeof all);
    all &= __builtin_shufflevector(all, all, 4, 5, 6, 7, 0, 1, 2, 3);
    all &= __builtin_shufflevector(all, all, 2, 3, 0, 1, 6, 7, 4, 5);
    return (all[0] & all[1]) == -1;
}

/// Halves the number of candidates three times.
[[gnu::always_inline]] inline double lowest_of(const DoubleLanes& all) {
    DoubleLanes lanes = all;
    const auto keep_lower = [&](const DoubleLanes& others) { lanes = others < lanes ? others : lanes; };
    keep_lower(__builtin_shufflevector(lanes, lanes, 4, 5, 6, 7, 0, 1, 2, 3));
    keep_lower(__builtin_shufflevector(lanes, lanes, 2, 3, 0, 1, 6, 7, 4, 5));
    keep_lower(__builtin_shufflevector(lanes, lanes, 1, 0, 3, 2, 5, 4, 7, 6));
    return lanes[0];
}
[[gnu::always_inline]] inline double highest_of(const DoubleLanes& all) {
    DoubleLanes lanes = all;
    const auto keep_higher = [&](const DoubleLanes& others) { lanes = others > lanes ? others : lanes; };
    keep_higher(__builtin_shufflevector(lanes, lanes, 4, 5, 6, 7, 0, 1, 2, 3));
    keep_higher(__builtin_shufflevector(lanes, lanes, 2, 3, 0, 1, 6, 7, 4, 5));
    keep_higher(__builtin_shufflevector(lanes, lanes, 1, 0, 3, 2, 5, 4, 7, 6));
    return lanes[0];
}

/// The same of 16 numbers.
[[gnu::always_inline]] inline double lowest_of(const std::array<double, 16>& numbers) {
    DoubleLanes a;
    DoubleLanes b;
    load(a, numbers.data());
    load(b, numbers.data() + 8);
    return lowest_of(b < a ? b : a);
}
[[gnu::always_inline]] inline double highest_of(const std::array<double, 16>& numbers) {
    DoubleLanes a;
    DoubleLanes b;
    load(a, numbers.data());
    load(b, numbers.data() + 8);
    return highest_of(b > a ? b : a);
}

}  // namespace lockstep::analysis
