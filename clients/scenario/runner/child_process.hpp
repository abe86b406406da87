// Starts programs by name, and either waits for their end or lets them run in the background.
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

/// Appends the program's output to the log. The error says why it cannot be started, with the remedy.
std::expected<pid_t, std::string> start_program(const CommandLine& words, const std::filesystem::path& log);

/// Fails if the program cannot be started or ends with a code other than 0. The error includes its last output.
std::expected<void, std::string> run_program(const CommandLine& words, const std::filesystem::path& log);

/// Returns the program's whole output. Fails like run_program().
std::expected<std::string, std::string> output_of_program(const CommandLine& words);

}  // namespace lockstep::scenario
