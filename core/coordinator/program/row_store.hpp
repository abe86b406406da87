// Keeps the blocks of a program as rows of numbers, all of one width, in order.
#pragma once

#include <algorithm>
#include <cstdint>
#include <expected>
#include <span>
#include <string>
#include <vector>

namespace lockstep {

class RowStore {
public:
    virtual ~RowStore() = default;
    /// Keeps all rows or none. Error: why they cannot be kept, and the remedy.
    virtual std::expected<void, std::string> append(std::span<const double> rows) = 0;
    /// Returns false if the row is not at hand yet. It is then fetched. Ask again in a later loop.
    virtual bool read(std::uint32_t number, std::span<double> row) = 0;
    /// How many more rows it can keep.
    virtual std::uint64_t free_rows() = 0;
    /// Rows before this one are not read any more. The store may keep others in their place.
    virtual void release_before(std::uint32_t /*number*/) {}
    /// The first row that is still kept.
    virtual std::uint32_t first_row() const { return 0; }
};

class MemoryRows final : public RowStore {
public:
    explicit MemoryRows(std::size_t width, std::uint64_t most_rows = 100'000'000)
        : width_(width), most_rows_(most_rows) {}

    std::expected<void, std::string> append(std::span<const double> rows) override {
        numbers_.insert(numbers_.end(), rows.begin(), rows.end());
        return {};
    }
    bool read(std::uint32_t number, std::span<double> row) override {
        std::ranges::copy(std::span(numbers_).subspan(number * width_, width_), row.begin());
        return true;
    }
    std::uint64_t free_rows() override { return most_rows_ - std::min(most_rows_, numbers_.size() / width_); }

private:
    std::size_t width_;
    std::uint64_t most_rows_;
    std::vector<double> numbers_;
};

}  // namespace lockstep
