// A queue in front of a sink. A separate thread writes to the sink, so the caller never waits for a slow disk.
//
// The queue is bounded. It counts the messages that do not fit, and writes a loss message to the sink in their place.
// While the sink can write nothing, losses are recorded in the space that it reserves for them: at once, whenever the
// loss has doubled, and at the end. They include the newest lost mark (record_marker.hpp), so that a log that ends in
// this way shows what it lacks.
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
    std::vector<std::uint8_t> mark;  // the process's newest mark that was lost; empty if none was

    void add(std::int64_t utime, std::span<const std::uint8_t> lost_mark);
    void add(const RecordLoss& later);
};

class QueuedSink final : public RecordSink {
public:
    /// At 100,000 steps/s an axis writes half a megabyte a second.
    static constexpr std::size_t kQueueBytes = 8 << 20;
    /// The caller allocates nothing while its messages of two seconds wait for the disk.
    static constexpr std::size_t kReserved_bytes = 1 << 20;
    static constexpr std::chrono::milliseconds kPeriod{20};  // how often the thread checks the queue

    /// Writes a loss to the given sink. The queue's thread calls this function and the sink `behind`; other threads
    /// never do.
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
    /// Messages, and the loss after them. After the first message that did not fit, all others are dropped, so that the
    /// log has one gap.
    struct Backlog {
        MessageBlock block;
        RecordLoss dropped;

        Backlog() { block.reserve(kReserved_bytes); }
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

    Backlog aside_;  // messages of the caller while the thread holds the queue

    std::mutex mutex_;  // guards queue_; the thread holds it only while it takes the queue
    std::condition_variable_any wake_;
    Backlog queue_;

    // Used by the thread:
    RecordLoss unreported_;                // losses that are not yet recorded
    std::uint64_t reported_in_a_row_ = 0;  // lost messages recorded since the last written message
    std::jthread thread_;
};

}  // namespace lockstep
