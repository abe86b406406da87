// Reads and writes a text file whole.
#pragma once

#include <expected>
#include <filesystem>
#include <string>
#include <string_view>

#include "services/files/diagnostic.hpp"

namespace lockstep {

inline constexpr std::size_t kMaxTextFileBytes = 64U << 20;

/// Refuses what is not a readable, regular, non-empty file of text (no 0 bytes) within the limit, and says why.
std::expected<std::string, Diagnostic> read_text_file(const std::filesystem::path& path);

/// In place of what was there. Error: the path, and why it cannot be written.
std::expected<void, std::string> write_text_file(const std::filesystem::path& path, std::string_view text);

/// Whole or not at all, whatever ends this process or its host: readers find the old text or the new one. The new one
/// is on the disk when it returns. One writer at a time. Error: the path, and why it cannot be written.
std::expected<void, std::string> replace_text_file(const std::filesystem::path& path, std::string_view text);

}  // namespace lockstep
