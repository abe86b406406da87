// A sink behind a queue, served by a thread of its own: who writes never waits, however long the disk takes.
//
// The queue is bounded. What finds no room is counted, and the sink behind is told so in a message of its own, in the
// place where it is missing. While nothing can be written, it is said in room that the sink behind keeps for that:
// at once, whenever the loss has doubled, and at the end; with the newest mark (record_witness.hpp) among what was
// lost, so that a log that ends like this shows what it lacks.
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
    std::vector<std::uint8_t> mark;  // the newest lost of the process's own; empty: none was

    void add(std::int64_t utime, std::span<const std::uint8_t> lost_mark);
    void add(const RecordLoss& later);
};

class QueuedSink final : public RecordSink {
public:
    /// At 100,000 steps/s an axis writes half a megabyte a second.
    static constexpr std::size_t kQueueBytes = 8 << 20;
    static constexpr std::chrono::milliseconds kPeriod{20};  // how often the thread looks into the queue

    /// `behind` is called by the thread alone, `say_loss` too: it writes a loss to the sink it is given.
    using SayLoss = std::function<void(RecordSink& behind, const RecordLoss& loss)>;
    QueuedSink(std::unique_ptr<RecordSink> behind, SayLoss say_loss, std::string mark_channel = {},
               std::size_t queue_bytes = kQueueBytes);
    /// Waits until all is written.
    ~QueuedSink() override;

    /// Never waits.
    void write(const std::string& channel, std::int64_t utime, std::span<const std::uint8_t> bytes) override;
    /// Messages that found no room or could not be written.
    std::uint64_t failures() const override { return lost_.load(std::memory_order_relaxed); }

private:
    /// Messages, and what did not fit behind them. After the first that did not fit none does, so that one place in the
    /// log lacks them all.
    struct Backlog {
        MessageBlock block;
        RecordLoss dropped;
    };

    void add(Backlog& backlog, std::string_view channel, std::int64_t utime, std::span<const std::uint8_t> bytes);
    void serve(const std::stop_token& stop);
    void write_out(const Backlog& backlog);
    void lose(RecordLoss& loss, std::string_view channel, std::int64_t utime, std::span<const std::uint8_t> bytes);
    bool say_unsaid(RecordSink& to);
    void say_in_kept_room(bool at_end);

    std::unique_ptr<RecordSink> behind_;
    SayLoss say_loss_;
    std::string mark_channel_;
    std::size_t queue_bytes_;
    std::atomic<std::uint64_t> lost_ = 0;

    Backlog aside_;  // the writer's own, for as long as the thread has the queue

    std::mutex mutex_;  // of queue_; the thread holds it while it takes the queue away
    std::condition_variable_any wake_;
    Backlog queue_;

    // The thread's:
    RecordLoss unsaid_;                // what could not be written, and not be said yet
    std::uint64_t said_in_a_row_ = 0;  // messages whose loss was said since one was written
    std::jthread thread_;
};

}  // namespace lockstep
