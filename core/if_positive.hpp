// Reads a number of which 0 means that it is not given: on the wire, in documents and in stored rows.
#pragma once

#include <optional>

namespace lockstep {

/// Returns the number, or nullopt if it is not above 0.
template <typename T>
constexpr std::optional<T> if_positive(T number) {
    return number > T{} ? std::optional(number) : std::nullopt;
}

}  // namespace lockstep
