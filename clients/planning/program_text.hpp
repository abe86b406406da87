// Reads the blocks of a G-code file on demand, so that the file may be of any length.
#pragma once

#include <deque>
#include <vector>

#include "core/gcode/gcode_stream.hpp"
#include "core/program_blocks.hpp"
#include "services/files/diagnostic.hpp"
#include "services/files/line_reader.hpp"

namespace lockstep {

/// Whether a program has probing moves. The part behind such a move depends on the touch.
bool does_probe(const Program& program);

/// Blocks must be requested in order; blocks before the last requested one are dropped. No block follows the first line
/// with an error. A subroutine must precede its call or be in a file of its name.
class ProgramText final : public ProgramBlocks {
public:
    ProgramText(LineReader lines, const GcodeSetup& setup);

    const ProgramHead& head() const { return head_; }
    const std::vector<std::string>& axes() const override { return head_.axes; }
    const Block* block(std::uint32_t number) const override;
    bool ends_before(std::uint32_t number) const override;
    /// The place before the last requested block.
    std::optional<std::span<const double>> place_before(std::uint32_t /*number*/) const override { return at_mm_; }

    /// With GcodeSetup::awaits_touches: the blocks so far end with a probing move, and those behind it are another
    /// program.
    bool awaits_touch() const { return gcode_.awaits_touch(); }
    /// Begins that program: its blocks are numbered from 0, and it has another head(). Call when all blocks were read.
    void touched(const ProbeTouch& touch);

    /// Moves the next blocks to the end of `out`, at most `count`, in place of requests of single blocks. Places are
    /// then not known. Returns false if no block follows.
    bool take_blocks(std::size_t count, std::vector<Block>& out);

    /// The errors by line and column, at most kMaxGcodeErrors. Reads on after the first line with an error.
    const Diagnostics& errors();
    /// Ignored words, and messages.
    const std::vector<GcodeNote>& notes() const { return notes_; }
    int lines() const { return line_; }
    double share_read() const { return lines_.share_read(); }

private:
    bool read_line() const;
    void take_blocks() const;
    void report(const GcodeError& error) const;

    // Mutable because const functions read ahead. Reading does not change the program.
    mutable LineReader lines_;
    mutable GcodeStream gcode_;
    ProgramHead head_;
    mutable std::vector<Block> taken_;   // of the last line
    mutable std::deque<Block> blocks_;   // from the last requested block on
    mutable std::uint32_t first_ = 0;    // number of the first of blocks_
    mutable std::vector<double> at_mm_;  // the place before blocks_
    mutable Diagnostics errors_;
    mutable std::vector<GcodeNote> notes_;
    mutable int line_ = 0;  // number of the last line read
    mutable bool is_over_ = false;
    mutable bool has_repeated_ = false;
};

}  // namespace lockstep
