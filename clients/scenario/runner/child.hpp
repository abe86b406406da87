// Programs started by name: to their end, or beside this one.
#pragma once

#include <sys/types.h>

#include <expected>
#include <filesystem>
#include <string>
#include <vector>

namespace lockstep::scenario {

using Words = std::vector<std::string>;

/// What blanks separate.
Words words_of(const std::string& text);

/// What it says goes to the end of the log. Error: it cannot be started, and the remedy.
std::expected<pid_t, std::string> start_program(const Words& words, const std::filesystem::path& log);

/// Error: it cannot be started, or ended with another code than 0; with the last it said.
std::expected<void, std::string> run_program(const Words& words, const std::filesystem::path& log);

/// All that it said. Error: as above.
std::expected<std::string, std::string> said_by_program(const Words& words);

}  // namespace lockstep::scenario
