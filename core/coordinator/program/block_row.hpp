// A block of a program as a row of numbers, as a coordinator keeps it.
//
//     0  line and kind    1  feed, seconds or value    2  details (packed)    3  tolerance, mm, or index
//     4, 5  centre of an arc, mm    then the place after the block, mm
#pragma once

#include <cstddef>
#include <span>
#include <vector>

#include "core/program.hpp"

namespace lockstep {

inline constexpr std::size_t kRowHead = 6;

constexpr std::size_t row_width(std::size_t axes) { return kRowHead + axes; }
/// Appends the row of a block. `place_mm`: where the axes are after the block.
void append_row(const Block& block, std::span<const double> place_mm, std::vector<double>& rows);
inline std::span<const double> place_of_row(std::span<const double> row) { return row.subspan(kRowHead); }

/// Converts rows to blocks, in memory that it keeps.
class RowReader {
public:
    /// Valid until the next call.
    const Block& read(std::span<const double> row);

private:
    Block move_;   // the last move: its vector of places keeps its memory
    Block other_;  // the last block that was no move
};

}  // namespace lockstep
