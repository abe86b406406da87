// The link to one board: a register window for each of its motors in shared memory, which the processes of these motors
// open by board:NAME/N.
#pragma once

#include <filesystem>
#include <optional>
#include <string>

namespace lockstep {

struct BoardOptions {
    std::string machine_file;
    std::string board;  // its name in the file
    std::optional<std::filesystem::path> log_file;
};

/// Serves until SIGINT or SIGTERM. Returns the exit code.
int serve_board(const BoardOptions& options);

}  // namespace lockstep
