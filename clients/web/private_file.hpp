// Makes a file for secrets, which only its user can read.
#pragma once

#include <expected>
#include <filesystem>
#include <string>

namespace lockstep::web {

/// Makes the file, mode 0600. Fails if it exists or cannot be written; the error has no remedy.
std::expected<void, std::string> make_private_file(const std::filesystem::path& file, const std::string& text);

}  // namespace lockstep::web
