// Reads and writes a text file whole.
#pragma once

#include <sys/types.h>

#include <expected>
#include <filesystem>
#include <string>
#include <string_view>

#include "services/files/diagnostic.hpp"

namespace lockstep {

inline constexpr std::size_t kMaxTextFileBytes = 64U << 20;

/// Reads a regular, non-empty text file without 0 bytes and within the limit. Error: why it refuses the file.
std::expected<std::string, Diagnostic> read_text_file(const std::filesystem::path& path);

/// Replaces the content. Error: the path, and why it cannot be written.
std::expected<void, std::string> write_text_file(const std::filesystem::path& path, std::string_view text);

/// Creates the file with its final mode, so that others can never read a private one. On return the text is on the
/// disk. Error: the path, and why it cannot be written, for example because it exists.
std::expected<void, std::string> create_text_file(const std::filesystem::path& path, std::string_view text,
                                                  mode_t mode);

/// Replaces the content atomically: readers find the old text or the new one, even if this process or its host fails.
/// On return the new text is on the disk. Only one thread of a process may replace a file at a time; several processes
/// may. Error: the path, and why it cannot be written.
std::expected<void, std::string> replace_text_file(const std::filesystem::path& path, std::string_view text);

}  // namespace lockstep
