// The program of a job in a log. Its blocks are read from the log on demand, so the program may be of any length.
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

/// The offsets in a log of the messages with the parts of a program, in the order of the program.
struct ProgramPlaces {
    std::filesystem::path log;
    std::vector<std::uint64_t> offsets;
    bool operator==(const ProgramPlaces&) const = default;
};

/// Only one thread may use it at a time.
class RecordedProgram final : public ProgramBlocks {
public:
    /// Keeps the whole program in memory.
    explicit RecordedProgram(Program program);
    /// Reads and checks the whole program once. Fails if a part cannot be read.
    static std::expected<std::shared_ptr<const RecordedProgram>, std::string> open(const ProgramPlaces& places);

    const ProgramHead& head() const { return head_; }
    const std::vector<std::string>& axes() const override { return head_.axes; }
    std::uint32_t size() const { return size_; }
    const Block* block(std::uint32_t number) const override;
    bool ends_before(std::uint32_t number) const override { return number >= size_; }
    std::optional<std::span<const double>> place_before(std::uint32_t number) const override;
    /// The blocks that are events, in order.
    const std::vector<std::uint32_t>& events() const { return events_; }
    /// Why a block could not be read: the log was changed after open().
    const std::optional<std::string>& failure() const { return failure_; }

    /// The number of parts kept in memory; more than one, because a planner reads ahead of the axes.
    static constexpr std::size_t kPartsLoaded = 4;

private:
    struct Part {
        std::uint64_t offset = 0;
        std::uint32_t first = 0;    // number of its first block
        std::vector<double> at_mm;  // position of the axes before that block
    };
    struct Loaded {
        std::size_t part = 0;
        std::vector<Block> blocks;
        std::uint64_t used = 0;  // 0 if nothing is loaded
    };

    explicit RecordedProgram(LogReader log) : log_(std::move(log)) {}
    std::expected<void, std::string> scan(const std::vector<std::uint64_t>& offsets);
    void note_blocks(const std::vector<Block>& blocks);
    std::expected<Program, std::string> read_part(std::uint64_t offset, bool is_first) const;
    std::size_t part_of(std::uint32_t number) const;
    const std::vector<Block>* load(std::size_t part) const;

    // Reading changes only the loaded parts, not the program.
    mutable std::optional<LogReader> log_;  // nullopt if the whole program is in memory
    mutable std::array<Loaded, kPartsLoaded> loaded_;
    mutable std::uint64_t uses_ = 0;
    mutable std::optional<std::string> failure_;
    ProgramHead head_;
    std::vector<Part> parts_;
    std::vector<std::uint32_t> events_;
    std::vector<double> end_mm_;  // after its last block
    std::uint32_t size_ = 0;
};

}  // namespace lockstep::analysis
