// Names and rows for each value of an enumeration. The compiler checks that none is missing. The enumerations count
// from 0 without gaps.
#pragma once

#include <array>
#include <cstddef>
#include <source_location>
#include <string_view>

#include "core/check.hpp"

namespace lockstep {
namespace detail {

/// The compiler writes a value that has no name as a number with its type in brackets: "(StepMethod)5".
template <auto kValue>
consteval bool has_name() {
    constexpr std::string_view kMark = "kValue = ";
    const std::string_view function = std::source_location::current().function_name();
    return function[function.find(kMark) + kMark.size()] != '(';
}

template <typename Enum, std::size_t kCounted = 0>
consteval std::size_t count_values() {
    if constexpr (has_name<static_cast<Enum>(kCounted)>()) { return count_values<Enum, kCounted + 1>(); }
    return kCounted;
}

}  // namespace detail

/// The number of values of an enumeration.
template <typename Enum>
inline constexpr std::size_t kCountOf = detail::count_values<Enum>();

/// The name of a value. `names`: of all values, in their order. "unknown" if the enumeration does not have the value,
/// as in a damaged file.
template <typename Enum, std::size_t kNames>
constexpr std::string_view pick_name(const std::string_view (&names)[kNames], Enum value) {
    static_assert(kNames == kCountOf<Enum>, "each value has a name");
    const auto i = static_cast<std::size_t>(value);
    return i < kNames ? names[i] : "unknown";
}

/// The row of a value. `rows`: of all values, in their order.
template <typename Enum, typename Row, std::size_t kRows>
constexpr const Row& pick_row(const std::array<Row, kRows>& rows, Enum value) {
    static_assert(kRows == kCountOf<Enum>, "each value has a row");
    const auto i = static_cast<std::size_t>(value);
    check(i < kRows, "a value is one of its enumeration");
    return rows[i];
}

}  // namespace lockstep
