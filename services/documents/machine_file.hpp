// The machine's configuration file: idl/proto/machine.proto in protobuf's text format.
//
// A file is accepted whole, or refused with all its errors. Optional keys have the defaults that machine.proto
// documents; a key that it does not document is an error.
#pragma once

#include <cstdint>
#include <expected>
#include <filesystem>
#include <string>
#include <string_view>

#include "core/machine.hpp"
#include "services/files/diagnostic.hpp"

namespace lockstep {

std::expected<MachineConfig, Diagnostics> parse_machine(std::string_view text);

std::expected<MachineConfig, Diagnostics> load_machine_file(const std::filesystem::path& path);

/// Writes every key; parse_machine returns the same configuration, bit for bit.
std::string machine_text(const MachineConfig& machine);

/// FNV-1a of the configuration with its defaults filled in: equal for files with the same meaning. Never 0.
std::uint64_t config_hash(const MachineConfig& machine);

}  // namespace lockstep
