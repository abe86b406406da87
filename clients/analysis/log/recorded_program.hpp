// The program of a job in a log. Its blocks are read from there when they are asked for, so it may be of any length.
#pragma once

#include <array>
#include <cstddef>
#include <cstdint>
#include <expected>
#include <filesystem>
#include <memory>
#include <optional>
#include <span>
#include <string>
#include <vector>

#include "core/program_blocks.hpp"
#include "services/wire/lcm/lcm_log.hpp"

namespace lockstep::analysis {

/// Where the messages with the parts of a program begin in a log, in the order of the program.
struct ProgramPlaces {
    std::filesystem::path log;
    std::vector<std::uint64_t> offsets;
    bool operator==(const ProgramPlaces&) const = default;
};

/// Used by one thread at a time.
class RecordedProgram final : public ProgramBlocks {
public:
    /// One that is in memory.
    explicit RecordedProgram(Program program);
    /// Reads and checks all of it once. Error: a part cannot be read.
    static std::expected<std::shared_ptr<const RecordedProgram>, std::string> open(const ProgramPlaces& places);

    const ProgramHead& head() const { return head_; }
    const std::vector<std::string>& axes() const override { return head_.axes; }
    std::uint32_t size() const { return size_; }
    const Block* block(std::uint32_t number) const override;
    bool ends_before(std::uint32_t number) const override { return number >= size_; }
    std::optional<std::span<const double>> place_before(std::uint32_t number) const override;
    /// The blocks that are events, in order.
    const std::vector<std::uint32_t>& events() const { return events_; }
    /// Why a block was not at hand: the log was altered after open().
    const std::optional<std::string>& failure() const { return failure_; }

    /// Parts in memory: a planner reads ahead of where the axes are.
    static constexpr std::size_t kPartsLoaded = 4;

private:
    struct Part {
        std::uint64_t offset = 0;
        std::uint32_t first = 0;    // its first block
        std::vector<double> at_mm;  // where the program has its axes before that
    };
    struct Loaded {
        std::size_t part = 0;
        std::vector<Block> blocks;
        std::uint64_t used = 0;  // 0: nothing is loaded
    };

    explicit RecordedProgram(LogReader log) : log_(std::move(log)) {}
    std::expected<void, std::string> scan(const std::vector<std::uint64_t>& offsets);
    void note_blocks(const std::vector<Block>& blocks);
    std::expected<Program, std::string> read_part(std::uint64_t offset, bool is_first) const;
    std::size_t part_of(std::uint32_t number) const;
    const std::vector<Block>* load(std::size_t part) const;

    // Reading changes what is in memory, and nothing about the program.
    mutable std::optional<LogReader> log_;  // none: all of it is loaded
    mutable std::array<Loaded, kPartsLoaded> loaded_;
    mutable std::uint64_t uses_ = 0;
    mutable std::optional<std::string> failure_;
    ProgramHead head_;
    std::vector<Part> parts_;
    std::vector<std::uint32_t> events_;
    std::vector<double> end_mm_;  // behind its last block
    std::uint32_t size_ = 0;
};

}  // namespace lockstep::analysis
