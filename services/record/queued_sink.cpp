#include "services/record/queued_sink.hpp"

#include <utility>

namespace lockstep {

void RecordLoss::add(std::int64_t utime) { add(RecordLoss{1, utime, utime}); }

void RecordLoss::add(const RecordLoss& later) {
    if (later.messages == 0) { return; }
    first_utime = messages == 0 ? later.first_utime : first_utime;
    last_utime = later.last_utime;
    messages += later.messages;
}

QueuedSink::QueuedSink(std::unique_ptr<RecordSink> behind, SayLoss say_loss, std::size_t queue_bytes)
    : behind_(std::move(behind)),
      say_loss_(std::move(say_loss)),
      queue_bytes_(queue_bytes),
      thread_([this](const std::stop_token& stop) { serve(stop); }) {}

QueuedSink::~QueuedSink() {
    thread_.request_stop();
    thread_.join();
    write_out(aside_);
}

void QueuedSink::add(Backlog& backlog, std::string_view channel, std::int64_t utime,
                     std::span<const std::uint8_t> bytes) {
    if (backlog.dropped.messages == 0 && backlog.block.bytes() + bytes.size() <= queue_bytes_) {
        return backlog.block.add(channel, utime, bytes);
    }
    backlog.dropped.add(utime);
    lost_.fetch_add(1, std::memory_order_relaxed);
}

/// The order is kept: what was put aside goes first.
void QueuedSink::write(const std::string& channel, std::int64_t utime, std::span<const std::uint8_t> bytes) {
    const std::unique_lock lock(mutex_, std::try_to_lock);
    if (!lock) { return add(aside_, channel, utime, bytes); }
    aside_.block.each([this](const MessageBlock::Message& m) { add(queue_, m.channel, m.utime, m.data); });
    queue_.dropped.add(aside_.dropped);
    aside_.block.clear();
    aside_.dropped = {};
    add(queue_, channel, utime, bytes);
}

void QueuedSink::serve(const std::stop_token& stop) {
    Backlog taken;
    for (bool ends = false; !ends;) {
        {
            std::unique_lock lock(mutex_);
            wake_.wait_for(lock, stop, kPeriod, [] { return false; });
            ends = stop.stop_requested();
            std::swap(taken, queue_);
        }
        write_out(taken);
        taken.block.clear();
        taken.dropped = {};
    }
}

void QueuedSink::write_out(const Backlog& backlog) {
    backlog.block.each([this](const MessageBlock::Message& message) {
        say_unsaid();
        const std::uint64_t failed = behind_->failures();
        behind_->write(std::string(message.channel), message.utime, message.data);
        if (behind_->failures() == failed) { return; }
        unsaid_.add(message.utime);
        lost_.fetch_add(1, std::memory_order_relaxed);
    });
    unsaid_.add(backlog.dropped);
    say_unsaid();
    if (!backlog.block.empty()) { behind_->flush(); }
}

/// What cannot be said now is said later.
void QueuedSink::say_unsaid() {
    if (unsaid_.messages == 0) { return; }
    const std::uint64_t failed = behind_->failures();
    say_loss_(*behind_, unsaid_);
    if (behind_->failures() == failed) { unsaid_ = {}; }
}

}  // namespace lockstep
