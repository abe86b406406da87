// The blocks of a program as a stream: all of them, or those that are known so far.
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
    /// Valid until another block is asked for. Null: it is not at hand yet, or there is none.
    virtual const Block* block(std::uint32_t number) const = 0;
    /// There is no block of this number, and none will come.
    virtual bool ends_before(std::uint32_t number) const = 0;
    /// Where the program has its axes before a block that is at hand, in mm. Valid until another place or block is
    /// asked for. Nothing: it is not at hand yet.
    virtual std::optional<std::span<const double>> place_before(std::uint32_t number) const = 0;
    /// About how long the program takes from a place on, as far as it is known. 0: it is not estimated.
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

/// For as long as the caller keeps the program.
inline std::shared_ptr<const Program> borrowed(const Program& program) {
    return {std::shared_ptr<const Program>{}, &program};
}

}  // namespace lockstep
