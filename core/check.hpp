// Checks of preconditions and invariants. They are on in every build.
//
// A failed check is a defect of the program, never bad input. Continuing could move an axis to a wrong place, so the
// process reports the check and ends. That is the safe state of the machine: a device executes only frames that all
// axes have agreed on, and each of them ends at rest on the path (see ARCHITECTURE.md).
#pragma once

#include <source_location>
#include <string_view>

namespace lockstep {

/// Receives the broken promise and the source location of its check, just before the process aborts. It must not
/// throw, and must not rely on the state of the code that failed.
using CheckReporter = void (*)(std::string_view promise, const std::source_location& where);

/// Sets the reporter of this process and returns the previous one. The default writes a line to standard error.
CheckReporter set_check_reporter(CheckReporter reporter);

/// Reports the promise as broken, and aborts.
[[noreturn]] void fail_check(std::string_view promise, const std::source_location& where);

/// `promise`: what must hold, as a short statement: "a frame has room for its pieces".
constexpr void check(bool holds, std::string_view promise,
                     const std::source_location& where = std::source_location::current()) {
    if (!holds) [[unlikely]] { fail_check(promise, where); }
}

/// Returns what `pointer` points at. A null pointer is a failed check.
template <typename T>
T& check_found(T* pointer, std::string_view promise,
               const std::source_location& where = std::source_location::current()) {
    check(pointer != nullptr, promise, where);
    return *pointer;
}

}  // namespace lockstep
