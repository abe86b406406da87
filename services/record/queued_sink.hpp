// A sink behind a queue, served by its own thread: a writer never waits, however long the disk takes.
//
// The queue is bounded. Messages that do not fit are counted, and a loss message is written to the sink behind, in the
// place where they are missing. While nothing can be written, losses are recorded in the space that the sink behind
// reserves for them: at once, whenever the loss has doubled, and at the end; with the newest lost mark
// (record_marker.hpp), so that a log that ends in this way shows what it lacks.
#pragma once

#include <atomic>
#include <chrono>
#include <condition_variable>
#include <functional>
#include <memory>
#include <mutex>
#include <string>
#include <thread>
#include <vector>

#include "services/record/message_block.hpp"
#include "services/record/record_sink.hpp"

namespace lockstep {

/// Messages that are missing between two that were written.
struct RecordLoss {
    std::uint64_t messages = 0;
    std::int64_t first_utime = 0;
    std::int64_t last_utime = 0;
    std::vector<std::uint8_t> mark;  // the newest lost mark of the process's own; empty: none was

    void add(std::int64_t utime, std::span<const std::uint8_t> lost_mark);
    void add(const RecordLoss& later);
};

class QueuedSink final : public RecordSink {
public:
    /// At 100,000 steps/s an axis writes half a megabyte a second.
    static constexpr std::size_t kQueueBytes = 8 << 20;
    static constexpr std::chrono::milliseconds kPeriod{20};  // how often the thread checks the queue

    /// Only the thread calls `behind` and `write_loss`, which writes a loss to the given sink.
    using WriteLoss = std::function<void(RecordSink& behind, const RecordLoss& loss)>;
    QueuedSink(std::unique_ptr<RecordSink> behind, WriteLoss write_loss, std::string mark_channel = {},
               std::size_t queue_bytes = kQueueBytes);
    /// Waits until everything is written.
    ~QueuedSink() override;

    /// Never waits.
    void write(const std::string& channel, std::int64_t utime, std::span<const std::uint8_t> bytes) override;
    /// Messages that did not fit or could not be written.
    std::uint64_t failures() const override { return lost_.load(std::memory_order_relaxed); }

private:
    /// Messages, and the loss after them. After the first that did not fit all are dropped, so that the log lacks them
    /// in one place.
    struct Backlog {
        MessageBlock block;
        RecordLoss dropped;
    };

    void add(Backlog& backlog, std::string_view channel, std::int64_t utime, std::span<const std::uint8_t> bytes);
    void serve(const std::stop_token& stop);
    void write_out(const Backlog& backlog);
    void lose(RecordLoss& loss, std::string_view channel, std::int64_t utime, std::span<const std::uint8_t> bytes);
    bool report_losses(RecordSink& to);
    void report_in_kept_room(bool at_end);

    std::unique_ptr<RecordSink> behind_;
    WriteLoss write_loss_;
    std::string mark_channel_;
    std::size_t queue_bytes_;
    std::atomic<std::uint64_t> lost_ = 0;

    Backlog aside_;  // the writer's own, while the thread holds the queue

    std::mutex mutex_;  // of queue_; held by the thread while it takes the queue
    std::condition_variable_any wake_;
    Backlog queue_;

    // The thread's:
    RecordLoss unreported_;                // losses that are not yet recorded
    std::uint64_t reported_in_a_row_ = 0;  // lost messages recorded since one was written
    std::jthread thread_;
};

}  // namespace lockstep
