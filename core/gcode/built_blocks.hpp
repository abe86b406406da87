// The blocks of a program that is being built, until they are taken.
#pragma once

#include <cstddef>
#include <functional>
#include <utility>
#include <vector>

#include "core/program.hpp"

namespace lockstep {

/// Receives blocks of a program in order, and empties the vector.
using TakeBlocks = std::function<void(std::vector<Block>& blocks)>;

namespace gcode {

class BuiltBlocks {
public:
    /// From now on `take` gets the blocks whenever many wait. So a line of many blocks, such as the end of a loop,
    /// needs no more memory than others.
    void pass_on(TakeBlocks take) { pass_on_ = std::move(take); }

    /// Returns false if kMaxProgramBlocks were added since the last take(), whether they were passed on or not.
    bool add(Block block) {
        if (passed_ + blocks_.size() >= kMaxProgramBlocks) { return false; }
        blocks_.push_back(std::move(block));
        if (!pass_on_ || blocks_.size() < kMany) { return true; }
        passed_ += blocks_.size();
        pass_on_(blocks_);
        return true;
    }

    /// Moves the blocks that wait to `blocks`, whose memory is used for the next ones.
    void take(std::vector<Block>& blocks) {
        passed_ = 0;
        blocks.clear();
        blocks.swap(blocks_);
    }
    std::vector<Block> take() {
        std::vector<Block> blocks;
        take(blocks);
        return blocks;
    }

private:
    static constexpr std::size_t kMany = 1024;

    std::vector<Block> blocks_;
    TakeBlocks pass_on_;      // may be empty
    std::size_t passed_ = 0;  // since the last take()
};

}  // namespace gcode
}  // namespace lockstep
