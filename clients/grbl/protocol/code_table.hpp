// grbl's numbers with their names and meanings, for messages and for the CSV files that senders load.
#pragma once

#include <span>
#include <string_view>

namespace lockstep::grbl {

struct Code {
    int number = 0;
    std::string_view name;
    std::string_view text;       // a sentence
    std::string_view why_never;  // why lockstep-grbl never sends it; empty if it does
};

/// In the order of their numbers: those of grbl 1.1, then Lockstep's own.
std::span<const Code> error_codes();
std::span<const Code> alarm_codes();

/// Returns null if no such number exists.
const Code* find_code(std::span<const Code> codes, int number);

}  // namespace lockstep::grbl
