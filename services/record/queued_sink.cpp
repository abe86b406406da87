#include "services/record/queued_sink.hpp"

#include <utility>

namespace lockstep {

namespace {

/// The room that a sink keeps for what must be said.
class KeptRoom final : public RecordSink {
public:
    explicit KeptRoom(RecordSink& of) : of_(of) {}
    void write(const std::string& channel, std::int64_t utime, std::span<const std::uint8_t> bytes) override {
        of_.write_kept(channel, utime, bytes);
    }

private:
    RecordSink& of_;
};

}  // namespace

void RecordLoss::add(std::int64_t utime, std::span<const std::uint8_t> lost_mark) {
    add(RecordLoss{1, utime, utime, {lost_mark.begin(), lost_mark.end()}});
}

void RecordLoss::add(const RecordLoss& later) {
    if (later.messages == 0) { return; }
    first_utime = messages == 0 ? later.first_utime : first_utime;
    last_utime = later.last_utime;
    messages += later.messages;
    if (!later.mark.empty()) { mark = later.mark; }
}

QueuedSink::QueuedSink(std::unique_ptr<RecordSink> behind, SayLoss say_loss, std::string mark_channel,
                       std::size_t queue_bytes)
    : behind_(std::move(behind)),
      say_loss_(std::move(say_loss)),
      mark_channel_(std::move(mark_channel)),
      queue_bytes_(queue_bytes),
      thread_([this](const std::stop_token& stop) { serve(stop); }) {}

QueuedSink::~QueuedSink() {
    thread_.request_stop();
    thread_.join();
    write_out(aside_);
    say_in_kept_room(true);
}

void QueuedSink::lose(RecordLoss& loss, std::string_view channel, std::int64_t utime,
                      std::span<const std::uint8_t> bytes) {
    const bool is_mark = !mark_channel_.empty() && channel == mark_channel_;
    loss.add(utime, is_mark ? bytes : std::span<const std::uint8_t>{});
    lost_.fetch_add(1, std::memory_order_relaxed);
}

void QueuedSink::add(Backlog& backlog, std::string_view channel, std::int64_t utime,
                     std::span<const std::uint8_t> bytes) {
    const bool fits = backlog.dropped.messages == 0 && backlog.block.bytes() + bytes.size() <= queue_bytes_;
    fits ? backlog.block.add(channel, utime, bytes) : lose(backlog.dropped, channel, utime, bytes);
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
        (void)say_unsaid(*behind_);
        const std::uint64_t failed = behind_->failures();
        behind_->write(std::string(message.channel), message.utime, message.data);
        if (behind_->failures() != failed) { return lose(unsaid_, message.channel, message.utime, message.data); }
        said_in_a_row_ = 0;
    });
    unsaid_.add(backlog.dropped);
    (void)say_unsaid(*behind_);
    say_in_kept_room(false);
    if (!backlog.block.empty()) { behind_->flush(); }
}

/// What cannot be said now is said later.
bool QueuedSink::say_unsaid(RecordSink& to) {
    if (unsaid_.messages == 0) { return false; }
    const std::uint64_t failed = behind_->failures();
    say_loss_(to, unsaid_);
    if (behind_->failures() != failed) { return false; }
    unsaid_ = {};
    return true;
}

void QueuedSink::say_in_kept_room(bool at_end) {
    if (!at_end && unsaid_.messages <= said_in_a_row_) { return; }
    const std::uint64_t messages = unsaid_.messages;
    KeptRoom room(*behind_);
    if (!say_unsaid(room)) { return; }
    said_in_a_row_ += messages;
    behind_->flush();
}

}  // namespace lockstep
