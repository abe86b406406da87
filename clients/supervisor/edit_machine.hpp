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

/// Under the file's own name, where a link leads to it. Error: the file cannot be read or written, or what `edit` says;
/// the file is as it was.
std::expected<void, Failure> edit_machine(const std::filesystem::path& file, const EditText& edit);

}  // namespace lockstep
