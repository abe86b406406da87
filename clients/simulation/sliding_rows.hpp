// Keeps the rows of a program that is run once, from its begin to its end. Released rows are dropped.
#pragma once

#include <cstddef>
#include <deque>

#include "core/coordinator/program/row_store.hpp"

namespace lockstep {

class SlidingRows final : public RowStore {
public:
    SlidingRows(std::size_t width, std::uint64_t most_rows) : width_(width), most_rows_(most_rows) {}

    std::expected<void, std::string> append(std::span<const double> rows) override;
    /// Returns false for a row that was dropped.
    bool read(std::uint32_t number, std::span<double> row) override;
    std::uint64_t free_rows() override;
    /// Keeps the row before `number`, because the block of `number` begins where that row ends.
    void release_before(std::uint32_t number) override;
    std::uint32_t first_row() const override { return first_; }

    /// Raises the number of rows that it keeps.
    void widen(std::uint64_t rows) { most_rows_ += rows; }
    std::uint64_t kept() const { return numbers_.size() / width_; }
    /// The largest number of rows kept at once so far.
    std::uint64_t most_kept() const { return most_kept_; }

private:
    std::size_t width_;
    std::uint64_t most_rows_;
    std::uint64_t most_kept_ = 0;
    std::uint32_t first_ = 0;  // the lowest number of a kept row
    std::deque<double> numbers_;
};

}  // namespace lockstep
