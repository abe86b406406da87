// Brings a board with Lockstep's firmware into its boot mode, in which it shows the drive for another firmware.
#pragma once

#include <chrono>
#include <expected>
#include <filesystem>
#include <functional>
#include <vector>

#include "clients/text/failure.hpp"

namespace lockstep {

/// The lines of boards with Lockstep's firmware at this host's USB. devices: as /dev.
std::vector<std::filesystem::path> lockstep_lines(const std::filesystem::path& devices = "/dev");

/// The line that is there. Error: there is none, or several.
std::expected<std::filesystem::path, Failure> only_line(const std::vector<std::filesystem::path>& lines);

/// Closes the line at 1200 baud, on which the firmware restarts in its boot mode if no motor is enabled. Error: it
/// cannot be opened, because lockstep-board holds it, for example.
std::expected<void, Failure> ask_for_boot_mode(const std::filesystem::path& line);

/// Waits until `drives` finds a board's drive. Error: it has not come in time, with the remedy.
std::expected<std::filesystem::path, Failure> await_drive(
    const std::filesystem::path& line, const std::function<std::vector<std::filesystem::path>()>& drives,
    std::chrono::milliseconds patience, const std::filesystem::path& devices = "/dev");

}  // namespace lockstep
