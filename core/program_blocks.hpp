// The blocks of a program as a stream: all blocks, or those received so far.
#pragma once

#include <memory>
#include <optional>
#include <span>
#include <utility>

#include "core/path_place.hpp"
#include "core/program.hpp"

namespace lockstep {

class ProgramBlocks {
public:
    virtual ~ProgramBlocks() = default;
    virtual const std::vector<std::string>& axes() const = 0;
    /// Returns null if the block is not available yet or does not exist. Valid until another block is requested.
    virtual const Block* block(std::uint32_t number) const = 0;
    /// True if no block has this number and none will arrive.
    virtual bool ends_before(std::uint32_t number) const = 0;
    /// The position of the axes in the program before a block, in mm. Valid until another place or block is requested.
    /// Returns nullopt if the block is not available yet.
    virtual std::optional<std::span<const double>> place_before(std::uint32_t number) const = 0;
    /// The estimated duration of the program from a place on, as far as blocks are known. 0 without an estimate.
    virtual double seconds_from(const PathPlace& /*place*/) const { return 0; }
};

class WholeProgram final : public ProgramBlocks {
public:
    explicit WholeProgram(std::shared_ptr<const Program> program) : program_(std::move(program)) {}

    const std::vector<std::string>& axes() const override { return program_->axes; }
    const Block* block(std::uint32_t number) const override {
        return ends_before(number) ? nullptr : &program_->blocks[number];
    }
    bool ends_before(std::uint32_t number) const override { return number >= program_->blocks.size(); }

    std::optional<std::span<const double>> place_before(std::uint32_t number) const override {
        while (number > 0) {
            if (const auto* move = std::get_if<ProgramMove>(&program_->blocks[--number].action)) {
                return move->target_mm;
            }
        }
        return program_->start_mm;
    }

private:
    std::shared_ptr<const Program> program_;
};

/// A pointer without ownership: the caller must keep the program alive.
inline std::shared_ptr<const Program> borrowed(const Program& program) {
    return {std::shared_ptr<const Program>{}, &program};
}

}  // namespace lockstep
