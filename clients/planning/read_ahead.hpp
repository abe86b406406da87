// Reads a G-code file in a thread of its own, some thousand blocks ahead, while the blocks are planned.
#pragma once

#include <condition_variable>
#include <deque>
#include <memory>
#include <mutex>
#include <thread>
#include <vector>

#include "clients/planning/program_text.hpp"
#include "core/program_blocks.hpp"

namespace lockstep {

/// Blocks must be requested in order. A block is valid until the next call.
class ReadAhead final : public ProgramBlocks {
public:
    /// Nothing else may use the text before stop().
    explicit ReadAhead(std::shared_ptr<ProgramText> text);
    ~ReadAhead() override { stop(); }
    ReadAhead(const ReadAhead&) = delete;
    ReadAhead& operator=(const ReadAhead&) = delete;

    /// Ends the thread. Blocks that were not read yet do not follow.
    void stop();

    const std::vector<std::string>& axes() const override { return axes_; }
    const Block* block(std::uint32_t number) const override;
    bool ends_before(std::uint32_t number) const override;
    /// The place before the last requested block.
    std::optional<std::span<const double>> place_before(std::uint32_t /*number*/) const override { return at_mm_; }

    /// How far the text was read, some thousand blocks ahead at most.
    double share_read() const { return batch_.share_read; }
    int lines() const { return batch_.lines; }

private:
    struct Batch {
        std::vector<Block> blocks;
        double share_read = 0;
        int lines = 0;
        bool is_last = false;
    };
    static constexpr std::size_t kBatchBlocks = 1024;
    static constexpr std::size_t kMostBatches = 4;

    void read();
    bool put(Batch batch);
    Batch take() const;
    void pass(std::uint32_t end) const;

    std::shared_ptr<ProgramText> text_;
    std::vector<std::string> axes_;

    // Mutable because const functions take batches. This does not change the program.
    mutable Batch batch_;              // the present one
    mutable std::uint32_t begin_ = 0;  // number of its first block
    mutable std::uint32_t passed_ = 0;
    mutable std::vector<double> at_mm_;  // the place before the block `passed_`

    mutable std::mutex mutex_;
    mutable std::condition_variable changed_;
    mutable std::deque<Batch> batches_;
    bool is_stopped_ = false;
    bool is_over_ = false;  // the thread puts no more batches
    std::thread thread_;
};

}  // namespace lockstep
