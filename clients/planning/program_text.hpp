// Reads the blocks of a G-code file on demand, so that the file may be of any length.
#pragma once

#include <deque>
#include <functional>
#include <string_view>
#include <vector>

#include "core/gcode/gcode_stream.hpp"
#include "core/program_blocks.hpp"
#include "services/files/diagnostic.hpp"
#include "services/files/line_reader.hpp"

namespace lockstep {

/// Whether a program has probing moves. The part behind such a move depends on the touch.
bool does_probe(const Program& program);

/// Blocks must be requested in order; blocks before the last requested one are dropped. No block follows the first line
/// with an error. Unless the whole text is given, a subroutine must precede its call or be in a file of its name.
class ProgramText final : public ProgramBlocks {
public:
    /// `text`: the whole text, if it is known. It must outlive this.
    ProgramText(LineReader lines, const GcodeSetup& setup, std::string_view text = {});

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

    /// Reads the text up to its end, or to the first line with an error. `take` gets the blocks of each line, in place
    /// of requests of single blocks. A line of very many blocks, such as the end of a loop, is passed in several parts,
    /// also if it has an error behind them. Ends behind the line at which `take` returns false. Places are not known.
    void pass_blocks(const std::function<bool(std::vector<Block>& blocks)>& take);
    /// How many blocks pass_blocks() has passed.
    std::size_t passed() const { return passed_; }

    /// The errors by line and column, at most kMaxGcodeErrors. Reads on after the first line with an error.
    const Diagnostics& errors();
    /// Ignored words, and messages.
    const std::vector<GcodeNote>& notes() const { return notes_; }
    /// The value of #<_name> after the lines read so far; nullopt if they have not set it.
    std::optional<double> global(std::string_view name) const { return gcode_.global(name); }
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
    TakeBlocks pass_;  // within pass_blocks()
    std::size_t passed_ = 0;
    mutable int line_ = 0;  // number of the last line read
    mutable bool is_over_ = false;
    mutable bool has_repeated_ = false;
};

}  // namespace lockstep
