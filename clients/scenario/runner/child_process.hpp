// Starts programs by name: waits for their end, or lets them run beside this one.
#pragma once

#include <sys/types.h>

#include <expected>
#include <filesystem>
#include <string>
#include <vector>

namespace lockstep::scenario {

using CommandLine = std::vector<std::string>;

/// Splits at blanks.
CommandLine split_words(const std::string& text);

/// Appends its output to the log. Error: it cannot be started, and the remedy.
std::expected<pid_t, std::string> start_program(const CommandLine& words, const std::filesystem::path& log);

/// Error: it cannot be started, or ended with a code other than 0; with its last output.
std::expected<void, std::string> run_program(const CommandLine& words, const std::filesystem::path& log);

/// Its whole output. Error: as above.
std::expected<std::string, std::string> output_of_program(const CommandLine& words);

}  // namespace lockstep::scenario
