// Changes the text of a machine's file.
#pragma once

#include <expected>
#include <filesystem>
#include <functional>
#include <string>
#include <string_view>

#include "clients/text/failure.hpp"

namespace lockstep {

using EditText = std::function<std::expected<std::string, Diagnostics>(std::string_view text)>;

/// If `file` is a link, replaces the file that it leads to. Fails if the file cannot be read or written, or if `edit`
/// fails; then the file stays unchanged.
std::expected<void, Failure> edit_machine(const std::filesystem::path& file, const EditText& edit);

}  // namespace lockstep
