// A table of transitions of a state machine: rows with the members `from`, `event` and `to`.
#pragma once

#include <cstddef>
#include <optional>

namespace lockstep {

/// Returns the row for this state and event, or nullopt if the table has none.
template <typename Table, typename State, typename Event>
constexpr std::optional<std::size_t> find_row(const Table& table, State from, Event event) {
    for (std::size_t row = 0; row < table.size(); ++row) {
        if (table[row].from == from && table[row].event == event) { return row; }
    }
    return std::nullopt;
}

}  // namespace lockstep
