// Program <-> idl/proto/program.proto, as bytes for the network and as text for people.
//
// A program from outside is checked for everything that does not need the machine: sizes match, numbers are finite and
// within the limits of core/program.hpp, names are valid. The error names the value and the block.
#pragma once

#include <cstdint>
#include <expected>
#include <optional>
#include <span>
#include <string>
#include <string_view>
#include <vector>

#include "core/gcode/kept_values.hpp"
#include "core/program.hpp"

namespace lockstep {

inline constexpr std::size_t kMaxProgramBytes = 256U << 20;
inline constexpr std::size_t kMaxProgramName = 255;

/// A program, with the machine's values that it was read with and leaves, if it depends on them.
struct ProgramDocument {
    Program program;
    std::optional<gcode::ProgramValues> values;
};

std::vector<std::uint8_t> program_bytes(const Program& program, const std::optional<gcode::ProgramValues>& values = {});
std::expected<ProgramDocument, std::string> program_document_from_bytes(std::span<const std::uint8_t> bytes);
std::expected<Program, std::string> program_from_bytes(std::span<const std::uint8_t> bytes);

std::string program_text(const Program& program);
std::expected<Program, std::string> program_from_text(std::string_view text);

}  // namespace lockstep
