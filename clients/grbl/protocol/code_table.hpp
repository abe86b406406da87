// grbl's numbers with their names and meanings: for messages, and as the CSV files that senders load.
#pragma once

#include <span>
#include <string>
#include <string_view>

namespace lockstep::grbl {

struct Code {
    int number = 0;
    std::string_view name;
    std::string_view text;            // a sentence
    std::string_view why_never = {};  // lockstep-grbl does not send it; empty: it does
};

/// In the order of their numbers: grbl 1.1's, then ours.
std::span<const Code> error_codes();
std::span<const Code> alarm_codes();

/// Null: there is no such number.
const Code* find_code(std::span<const Code> codes, int number);

/// With the head line that senders expect.
std::string error_csv();
std::string alarm_csv();

}  // namespace lockstep::grbl
