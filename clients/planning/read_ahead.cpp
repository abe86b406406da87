#include "clients/planning/read_ahead.hpp"

#include <algorithm>
#include <iterator>
#include <utility>

namespace lockstep {

ReadAhead::ReadAhead(std::shared_ptr<ProgramText> text)
    : text_(std::move(text)), axes_(text_->head().axes), at_mm_(text_->head().start_mm), thread_([this] { read(); }) {}

void ReadAhead::stop() {
    {
        const std::lock_guard lock(mutex_);
        is_stopped_ = true;
    }
    changed_.notify_all();
    if (thread_.joinable()) { thread_.join(); }
}

/// The thread.
void ReadAhead::read() {
    Batch batch;
    const auto put_batch = [&] {
        batch.share_read = text_->share_read();
        batch.lines = text_->lines();
        return put(std::exchange(batch, {}));
    };
    text_->pass_blocks([&](std::vector<Block>& blocks) {
        std::ranges::move(blocks, std::back_inserter(batch.blocks));
        return batch.blocks.size() < kBatchBlocks || put_batch();
    });
    batch.is_last = true;
    (void)put_batch();
    const std::lock_guard lock(mutex_);
    is_over_ = true;
    changed_.notify_all();
}

/// Returns false if the thread must end.
bool ReadAhead::put(Batch batch) {
    std::unique_lock lock(mutex_);
    changed_.wait(lock, [this] { return is_stopped_ || batches_.size() < kMostBatches; });
    if (is_stopped_) { return false; }
    batches_.push_back(std::move(batch));
    changed_.notify_all();
    return true;
}

ReadAhead::Batch ReadAhead::take() const {
    std::unique_lock lock(mutex_);
    changed_.wait(lock, [this] { return is_over_ || !batches_.empty(); });
    if (batches_.empty()) { return {.blocks = {}, .is_last = true}; }
    Batch batch = std::move(batches_.front());
    batches_.pop_front();
    changed_.notify_all();
    return batch;
}

/// Notes the place behind the blocks before `end`.
void ReadAhead::pass(std::uint32_t end) const {
    for (; passed_ < end; ++passed_) {
        const Block& block = batch_.blocks[passed_ - begin_];
        if (const auto* move = std::get_if<ProgramMove>(&block.action)) { at_mm_ = move->target_mm; }
    }
}

bool ReadAhead::ends_before(std::uint32_t number) const {
    for (;;) {
        const auto end = begin_ + static_cast<std::uint32_t>(batch_.blocks.size());
        if (number < end) { return false; }
        if (batch_.is_last) { return true; }
        pass(end);
        begin_ = end;
        batch_ = take();
    }
}

const Block* ReadAhead::block(std::uint32_t number) const {
    if (ends_before(number) || number < passed_) { return nullptr; }
    pass(number);
    return &batch_.blocks[number - begin_];
}

}  // namespace lockstep
