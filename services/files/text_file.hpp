// Reads and writes a text file whole.
#pragma once

#include <expected>
#include <filesystem>
#include <string>
#include <string_view>

#include "services/files/diagnostic.hpp"

namespace lockstep {

inline constexpr std::size_t kMaxTextFileBytes = 64U << 20;

/// Refuses anything but a readable, regular, non-empty text file (no 0 bytes) within the limit, with the reason.
std::expected<std::string, Diagnostic> read_text_file(const std::filesystem::path& path);

/// Replaces the content. Error: the path, and why it cannot be written.
std::expected<void, std::string> write_text_file(const std::filesystem::path& path, std::string_view text);

/// Atomic even if this process or its host fails: readers find the old text or the new one. The new text is on the
/// disk on return. One thread of a process at a time; processes do not disturb each other. Error: the path, and why it
/// cannot be written.
std::expected<void, std::string> replace_text_file(const std::filesystem::path& path, std::string_view text);

}  // namespace lockstep
