// The inputs of an interpreter other than the program's text.
#pragma once

#include <cstddef>
#include <cstdint>
#include <functional>
#include <optional>
#include <string>
#include <string_view>

namespace lockstep::gcode {

/// A program that exceeds one of these is refused.
struct Limits {
    std::size_t call_depth = 10;               // of subroutines that call each other
    std::int64_t repeated_lines = 10'000'000;  // lines and actions of loops and subroutines, all together
    std::int64_t idle_lines = 1'000'000;       // lines of loops and subroutines without an action between them
    std::size_t kept_lines = 100'000;          // lines of loops and subroutines, all together
};

struct Setup {
    std::string axes = "XYZABCUVW";  // those of these letters that the machine has
    bool skip_deletable = true;      // block delete: lines that begin with / are not run
    bool awaits_touches = false;     // behind a probing move it waits for the touch; false: this is the end of the move
    Limits limits;
    /// The whole text, if it is known. A subroutine may then be behind its call. It must outlive the interpreter.
    std::string_view program;
    /// The text of the file of a subroutine that the program calls but does not contain; the name is in small letters.
    std::function<std::optional<std::string>(std::string_view name)> find_subroutine;
};

}  // namespace lockstep::gcode
