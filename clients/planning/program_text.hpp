// The blocks of a G-code file, read as they are asked for: the file may be of any length.
#pragma once

#include <deque>
#include <vector>

#include "core/gcode/gcode_stream.hpp"
#include "core/program_blocks.hpp"
#include "services/files/diagnostic.hpp"
#include "services/files/line_reader.hpp"

namespace lockstep {

/// Blocks are asked for in their order; those before the last one asked for are forgotten. Behind the first wrong line
/// there is no block. A subroutine stands before its call, or in a file of its name.
class ProgramText final : public ProgramBlocks {
public:
    ProgramText(LineReader lines, const GcodeSetup& setup);

    const ProgramHead& head() const { return head_; }
    const std::vector<std::string>& axes() const override { return head_.axes; }
    const Block* block(std::uint32_t number) const override;
    bool ends_before(std::uint32_t number) const override;
    /// Of the last one asked for.
    std::optional<std::span<const double>> place_before(std::uint32_t /*number*/) const override { return at_mm_; }

    /// What is wrong, by line and column, at most kMaxGcodeErrors. Reads on behind the first wrong line.
    const Diagnostics& errors();
    /// Words that were passed over, and messages.
    const std::vector<GcodeNote>& notes() const { return notes_; }
    int lines() const { return line_; }
    double share_read() const { return lines_.share_read(); }

private:
    bool read_line() const;
    void report(const GcodeError& error) const;

    // Reading changes what is known, and nothing about the program.
    mutable LineReader lines_;
    mutable GcodeStream gcode_;
    ProgramHead head_;
    mutable std::deque<Block> blocks_;   // from the last one asked for on
    mutable std::uint32_t first_ = 0;    // of them
    mutable std::vector<double> at_mm_;  // before them
    mutable Diagnostics errors_;
    mutable std::vector<GcodeNote> notes_;
    mutable int line_ = 0;  // the last one read
    mutable bool is_over_ = false;
    mutable bool has_repeated_ = false;
};

}  // namespace lockstep
