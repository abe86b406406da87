// Program <-> idl/proto/program.proto, as bytes for the network and as text for people.
//
// A program from outside is checked for everything that does not need the machine: sizes match, numbers are finite and
// within the limits of core/program.hpp, names are valid. The error names the value and the block.
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

/// A program, with the machine's values that it was read with and leaves, if it depends on them.
struct ProgramDocument {
    Program program;
    std::optional<gcode::ProgramValues> values;
    std::string cut;  // why the program ends before its end; empty: it does not
};

std::vector<std::uint8_t> program_bytes(const Program& program, const std::optional<gcode::ProgramValues>& values = {});
/// `axes`: of a part of a program behind its first, which names no axes; how many the program has. The values of such a
/// part have no revision.
std::expected<ProgramDocument, std::string> program_document_from_bytes(std::span<const std::uint8_t> bytes,
                                                                        std::optional<std::size_t> axes = {});
std::expected<Program, std::string> program_from_bytes(std::span<const std::uint8_t> bytes);

std::string program_text(const Program& program);
std::expected<Program, std::string> program_from_text(std::string_view text);

// ---- Parts: each has whole blocks and is read by itself; their bytes in order are those of the whole program.

/// A part is full when it has so many bytes or blocks.
inline constexpr std::size_t kPartBytes = 32'000;
inline constexpr std::size_t kPartBlocks = 2'000;

class ProgramPartWriter {
public:
    /// `values`: of the machine, that the program was read with, and leaves, if that is known already.
    explicit ProgramPartWriter(const ProgramHead& head, const std::optional<gcode::ProgramValues>& values = {});
    ~ProgramPartWriter();
    ProgramPartWriter(ProgramPartWriter&&) noexcept;
    ProgramPartWriter& operator=(ProgramPartWriter&&) noexcept;

    void add(const Block& block);
    /// The values that the program leaves: in its last part.
    void add_values(const gcode::KeptValues& after);
    /// Why the program ends before its end: in its last part.
    void add_cut(const std::string& why);
    bool is_full() const { return bytes_ >= kPartBytes || blocks_ >= kPartBlocks; }
    std::size_t blocks() const { return blocks_; }
    /// The part; the next one begins empty.
    std::vector<std::uint8_t> take();

private:
    struct Message;
    std::unique_ptr<Message> message_;
    std::size_t bytes_ = 0;
    std::size_t blocks_ = 0;
};

}  // namespace lockstep
