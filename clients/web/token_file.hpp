// The tokens of a server, in a file that only its user can read. They outlive the process, so that pages keep working.
#pragma once

#include <expected>
#include <filesystem>
#include <string>

#include "clients/web/api/access.hpp"

namespace lockstep::web {

/// Reads two lines, "operate TOKEN" and "view TOKEN". Makes the file with mode 0600 if it is missing. Fails if others
/// can read it, it is not in this form, or it cannot be made; the error has the remedy.
std::expected<Tokens, std::string> tokens_of_file(const std::filesystem::path& file);

}  // namespace lockstep::web
