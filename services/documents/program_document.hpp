// Program <-> idl/proto/program.proto, as bytes for the network and as text for people.
//
// A program from outside is checked for everything that does not need the machine: sizes match, numbers are finite and
// within the limits of core/program.hpp, names are valid. The error names the value and the block.
#pragma once

#include <cstdint>
#include <expected>
#include <span>
#include <string>
#include <string_view>
#include <vector>

#include "core/program.hpp"

namespace lockstep {

inline constexpr std::size_t kMaxProgramBytes = 256U << 20;
inline constexpr std::size_t kMaxProgramName = 255;

std::vector<std::uint8_t> program_bytes(const Program& program);
std::expected<Program, std::string> program_from_bytes(std::span<const std::uint8_t> bytes);

std::string program_text(const Program& program);
std::expected<Program, std::string> program_from_text(std::string_view text);

}  // namespace lockstep
