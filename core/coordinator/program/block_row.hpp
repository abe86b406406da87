// A block of a program as a row of numbers, as a coordinator keeps it.
//
//     0  line and kind    1  feed, seconds or value    2  details (packed)    3  tolerance, mm, or index, or text
//     4, 5  centre of an arc, mm, or mode and seconds of a wait    then the place after the block, mm
#pragma once

#include <cstddef>
#include <span>
#include <string>
#include <vector>

#include "core/program.hpp"

namespace lockstep {

inline constexpr std::size_t kRowHead = 6;

constexpr std::size_t row_width(std::size_t axes) { return kRowHead + axes; }
/// The texts of a program's pauses. Equal texts are kept once.
class PauseTexts {
public:
    static constexpr std::size_t kMost = 1000;  // different texts; pauses with others have none

    /// Returns the number of the text, for text_of(); 0 for an empty one, and for one that is not kept.
    std::int64_t keep(const std::string& text);
    const std::string& text_of(std::int64_t number) const;

private:
    std::vector<std::string> texts_;
};

/// Appends the row of a block. `place_mm`: where the axes are after the block.
void append_row(const Block& block, std::span<const double> place_mm, PauseTexts& texts, std::vector<double>& rows);
inline std::span<const double> place_of_row(std::span<const double> row) { return row.subspan(kRowHead); }

/// Converts rows to blocks, in memory that it keeps.
class RowReader {
public:
    /// `texts`: those with which the row was made. Valid until the next call.
    const Block& read(std::span<const double> row, const PauseTexts& texts);

private:
    Block move_;   // the last move: its vector of places keeps its memory
    Block other_;  // the last block that was no move
};

}  // namespace lockstep
