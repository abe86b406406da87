// Reads a text file whole.
#pragma once

#include <expected>
#include <filesystem>
#include <string>

#include "services/documents/diagnostic.hpp"

namespace lockstep {

inline constexpr std::size_t kMaxTextFileBytes = 64U << 20;

/// Refuses what is not a readable, regular, non-empty file of text (no 0 bytes) within the limit, and says why.
std::expected<std::string, Diagnostic> read_text_file(const std::filesystem::path& path);

}  // namespace lockstep
