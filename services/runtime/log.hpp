// The services' log: one line per event, "time level service axis code message", to standard error or a file.
#pragma once

#include <chrono>
#include <cstdint>
#include <expected>
#include <filesystem>
#include <iterator>
#include <optional>
#include <string>
#include <string_view>
#include <utility>

#include <spdlog/spdlog.h>

#include "core/faults.hpp"

namespace lockstep {

/// A log file of this size is renamed from NAME.log to NAME.1.log, and so on; the oldest is removed.
inline constexpr std::size_t kLogFileBytes = 4 << 20;
inline constexpr std::size_t kOlderLogFiles = 2;

struct LogTarget {
    std::string service;                        // "coordinator", "axis", ...
    std::string axis;                           // empty: none
    std::optional<std::filesystem::path> file;  // none: standard error
    bool in_background = false;                 // for a process with a loop: the loop never waits for the disk
};

/// Makes a logger for `target` spdlog's default. Error: the file's name, and why it cannot be opened.
std::expected<void, std::string> open_log(const LogTarget& target);

/// Waits until all lines so far are written, but at most for `most`.
void drain_log(std::chrono::milliseconds most);

/// Lines of a background log that were not written since it was opened, because the disk hung or was full.
std::uint64_t lost_log_lines();

/// Logs one line. Its code is the fault's stable name, or "-" for FaultCode::None.
void log_event(spdlog::level::level_enum level, FaultCode code, std::string_view message);
/// For use in a loop: it formats a line of usual length without allocation.
template <typename... Args>
requires(sizeof...(Args) > 0) void log_event(spdlog::level::level_enum level, FaultCode code,
                                             fmt::format_string<Args...> format, Args&&... args) {
    fmt::memory_buffer text;
    fmt::format_to(std::back_inserter(text), format, std::forward<Args>(args)...);
    log_event(level, code, std::string_view(text.data(), text.size()));
}

inline void log_info(std::string_view message) { log_event(spdlog::level::info, FaultCode::None, message); }
template <typename... Args>
requires(sizeof...(Args) > 0) void log_info(fmt::format_string<Args...> format, Args&&... args) {
    log_event(spdlog::level::info, FaultCode::None, format, std::forward<Args>(args)...);
}
inline void log_warning(std::string_view message) { log_event(spdlog::level::warn, FaultCode::None, message); }
template <typename... Args>
requires(sizeof...(Args) > 0) void log_warning(fmt::format_string<Args...> format, Args&&... args) {
    log_event(spdlog::level::warn, FaultCode::None, format, std::forward<Args>(args)...);
}
inline void log_error(std::string_view message) { log_event(spdlog::level::err, FaultCode::None, message); }

}  // namespace lockstep
