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

/// The first and the second half of the numbers, as doubles.
[[gnu::always_inline]] inline void to_doubles(const IntLanes& numbers, DoubleLanes& first, DoubleLanes& second) {
    first = __builtin_convertvector(__builtin_shufflevector(numbers, numbers, 0, 1, 2, 3, 4, 5, 6, 7), DoubleLanes);
    second =
        __builtin_convertvector(__builtin_shufflevector(numbers, numbers, 8, 9, 10, 11, 12, 13, 14, 15), DoubleLanes);
}

/// Divides as doubles: the first and the second half of the quotients.
[[gnu::always_inline]] inline void divide(const IntLanes& a, const IntLanes& b, DoubleLanes& first,
                                          DoubleLanes& second) {
    DoubleLanes of_a[2];
    DoubleLanes of_b[2];
    to_doubles(a, of_a[0], of_a[1]);
    to_doubles(b, of_b[0], of_b[1]);
    first = of_a[0] / of_b[0];
    second = of_a[1] / of_b[1];
}

/// Picks the numbers at rising places, which usually are near each other: from two vectors, without a load for each.
[[gnu::always_inline]] inline void pick(const std::int32_t* numbers, std::size_t size, const IntLanes& places,
                                        IntLanes& to) {
#ifndef __clang__
    constexpr std::int32_t kReach = 32;
    const std::int32_t base = std::min(places[0], static_cast<std::int32_t>(size) - kReach);
    if (base >= 0 && places[15] - base < kReach) {
        IntLanes a;
        IntLanes b;
        load(a, numbers + base);
        load(b, numbers + base + kReach / 2);
        to = __builtin_shuffle(a, b, places - base);
        return;
    }
#endif
    for (int i = 0; i < 16; ++i) { to[i] = numbers[places[i]]; }
}

/// Picks the numbers at 8 of the places.
[[gnu::always_inline]] inline void pick(const double* numbers, std::size_t size, const HalfIntLanes& places,
                                        DoubleLanes& to) {
#ifndef __clang__
    constexpr std::int32_t kReach = 16;
    const std::int32_t base = std::min(places[0], static_cast<std::int32_t>(size) - kReach);
    if (base >= 0 && places[7] - base < kReach) {
        DoubleLanes a;
        DoubleLanes b;
        load(a, numbers + base);
        load(b, numbers + base + kReach / 2);
        to = __builtin_shuffle(a, b, __builtin_convertvector(places - base, LongLanes));
        return;
    }
#endif
    for (int i = 0; i < 8; ++i) { to[i] = numbers[places[i]]; }
}
[[gnu::always_inline]] inline void pick(const double* numbers, std::size_t size, const IntLanes& places,
                                        DoubleLanes& first, DoubleLanes& second) {
    const HalfIntLanes half = __builtin_shufflevector(places, places, 0, 1, 2, 3, 4, 5, 6, 7);
    const HalfIntLanes other = __builtin_shufflevector(places, places, 8, 9, 10, 11, 12, 13, 14, 15);
    pick(numbers, size, half, first);
    pick(numbers, size, other, second);
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
    std::array<std::int64_t, 8> words;
    static_assert(sizeof words == sizeof results);
    std::memcpy(&words, &results, sizeof words);
    return ((words[0] & words[1]) & (words[2] & words[3]) & (words[4] & words[5]) & (words[6] & words[7])) == -1;
}

[[gnu::always_inline]] inline double lowest_of(const DoubleLanes& lanes) {
    const auto least = [&](int a, int b) { return lanes[b] < lanes[a] ? lanes[b] : lanes[a]; };
    return std::min(std::min(least(0, 1), least(2, 3)), std::min(least(4, 5), least(6, 7)));
}
[[gnu::always_inline]] inline double highest_of(const DoubleLanes& lanes) {
    const auto most = [&](int a, int b) { return lanes[b] > lanes[a] ? lanes[b] : lanes[a]; };
    return std::max(std::max(most(0, 1), most(2, 3)), std::max(most(4, 5), most(6, 7)));
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
