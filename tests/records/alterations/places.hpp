// Finds and changes single messages of a record.
#pragma once

#include <string>
#include <string_view>

#include "tests/records/alterations/alterations.hpp"

#include <functional>
#include <optional>
#include <string>

#include "tests/records/record.hpp"

namespace lockstep::records {

/// Kinds of motion with messages to alter: home, run, own-move.
inline constexpr const char* kMotions[]{"home", "run", "own-move"};
/// "in_homing", "in_a_job", "in_an_own_move"
std::string name_of_motion(const std::string& motion);

/// A message of at least five steps of axis X in the middle of the first motion of the kind.
std::optional<std::size_t> steps_in(const Record& record, const std::string& motion);
/// A run of axis X in the middle of the first motion of the kind, at speed.
std::optional<std::size_t> run_in(const Record& record, const std::string& motion);

template <typename Type>
bool change_at(Record& record, std::optional<std::size_t> place, const std::function<void(Type&)>& change) {
    if (!place) { return false; }
    auto content = decoded<Type>(record[*place]);
    if (!content) { return false; }
    change(*content);
    record[*place].data = encoded(*content);
    return true;
}

bool erase_at(Record& record, std::optional<std::size_t> place);
/// Repeats the message unchanged, directly behind it.
bool repeat_at(Record& record, std::optional<std::size_t> place);

/// Inserts the message behind the place with the number behind its number. Later messages of the process have higher
/// numbers then, and the marks count one more, as if the process had published it.
void insert_steps(Record& record, std::size_t behind, step_batch_t message);
void insert_run(Record& record, std::size_t behind, run_t message);

/// An axis's own moves follow its own clock only, so its machine time shows nothing there.
inline Needs clock_needs(std::string_view change, const std::string& motion) {
    const bool is_of_clock = change.starts_with("ahead") || change.starts_with("clock_error");
    return {.shared_clock = is_of_clock && motion != "run", .all_motions = motion != "run"};
}

}  // namespace lockstep::records
