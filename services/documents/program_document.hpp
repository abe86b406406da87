// Translates between Program and idl/proto/program.proto, as bytes for the network and as text for people.
//
// Reading checks everything that does not need the machine: sizes match, numbers are finite and within the limits of
// core/program.hpp, and names are valid. The error names the value and the block.
#pragma once

#include <cstdint>
#include <expected>
#include <memory>
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

/// A program. If it depends on the machine's values: also the values with which it was read and those that it leaves.
struct ProgramDocument {
    Program program;
    std::optional<gcode::ProgramValues> values;
    std::string cut;  // why the program was cut short; empty if it was not
};

std::vector<std::uint8_t> program_bytes(const Program& program, const std::optional<gcode::ProgramValues>& values = {});
/// A later part of a program names no axes. For such a part, `axes` is the program's number of axes, and the values
/// have no revision.
std::expected<ProgramDocument, std::string> program_document_from_bytes(std::span<const std::uint8_t> bytes,
                                                                        std::optional<std::size_t> axes = {});
std::expected<Program, std::string> program_from_bytes(std::span<const std::uint8_t> bytes);

std::string program_text(const Program& program);
std::expected<Program, std::string> program_from_text(std::string_view text);

// ---- Parts. A part has whole blocks and can be read alone. The parts' bytes in order are those of the whole program.

/// A part with this many bytes or blocks is full.
inline constexpr std::size_t kPartBytes = 32'000;
inline constexpr std::size_t kPartBlocks = 2'000;

class ProgramPartWriter {
public:
    /// `values` are the machine's values with which the program was read, and those that it leaves, if already known.
    explicit ProgramPartWriter(const ProgramHead& head, const std::optional<gcode::ProgramValues>& values = {});
    ~ProgramPartWriter();
    ProgramPartWriter(ProgramPartWriter&&) noexcept;
    ProgramPartWriter& operator=(ProgramPartWriter&&) noexcept;

    void add(const Block& block);
    /// Adds the values that the program leaves. Call it for the last part.
    void add_values(const gcode::KeptValues& after);
    /// Adds the reason why the program was cut short. Call it for the last part.
    void add_cut(const std::string& why);
    bool is_full() const { return bytes_ >= kPartBytes || blocks_ >= kPartBlocks; }
    std::size_t blocks() const { return blocks_; }
    /// Returns the part. The next part begins empty.
    std::vector<std::uint8_t> take();

private:
    struct Message;
    std::unique_ptr<Message> message_;
    std::size_t bytes_ = 0;
    std::size_t blocks_ = 0;
};

}  // namespace lockstep
