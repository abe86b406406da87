// Copies a board's firmware to the drive that a Raspberry Pi Pico shows while its button is held at power-up.
#pragma once

#include <expected>
#include <filesystem>
#include <string>
#include <vector>

#include "clients/text/failure.hpp"

namespace lockstep {

/// The firmware that comes with this program.
std::filesystem::path shipped_firmware();

/// The blocks of a UF2 file for this chip. Error: why it is none.
std::expected<std::string, Failure> read_firmware(const std::filesystem::path& file);

/// The drives of Picos that this host has mounted. `mounts`: the text of /proc/self/mounts.
std::vector<std::filesystem::path> pico_drives(const std::string& mounts);

/// The drive that is there. Error: there is none, or several.
std::expected<std::filesystem::path, Failure> only_drive(const std::vector<std::filesystem::path>& drives);

/// Returns when the drive has all of it. Error: why it has not.
std::expected<void, Failure> write_firmware(const std::string& firmware, const std::filesystem::path& drive);

}  // namespace lockstep
