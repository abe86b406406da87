// A file that only its user can read: it has secrets.
#pragma once

#include <expected>
#include <filesystem>
#include <string>

namespace lockstep::web {

/// Makes the file, mode 0600. Error: it is there already, or cannot be written; without a remedy.
std::expected<void, std::string> make_private_file(const std::filesystem::path& file, const std::string& text);

}  // namespace lockstep::web
