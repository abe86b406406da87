#include "services/record/queued_sink.hpp"

#include <utility>

namespace lockstep {

namespace {

/// Writes into the space that a sink reserves for loss messages.
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

QueuedSink::QueuedSink(std::unique_ptr<RecordSink> behind, WriteLoss write_loss, std::string mark_channel,
                       std::size_t queue_bytes)
    : behind_(std::move(behind)),
      write_loss_(std::move(write_loss)),
      mark_channel_(std::move(mark_channel)),
      queue_bytes_(queue_bytes),
      thread_([this](const std::stop_token& stop) { serve(stop); }) {}

QueuedSink::~QueuedSink() {
    thread_.request_stop();
    thread_.join();
    write_out(aside_);
    report_in_kept_room(true);
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

/// Keeps the order: it first queues the messages put aside.
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
        (void)report_losses(*behind_);
        const std::uint64_t failed = behind_->failures();
        behind_->write(std::string(message.channel), message.utime, message.data);
        if (behind_->failures() != failed) { return lose(unreported_, message.channel, message.utime, message.data); }
        reported_in_a_row_ = 0;
    });
    unreported_.add(backlog.dropped);
    (void)report_losses(*behind_);
    report_in_kept_room(false);
    if (!backlog.block.empty()) { behind_->flush(); }
}

/// Returns false if no loss was written. A loss that could not be written is written later.
bool QueuedSink::report_losses(RecordSink& to) {
    if (unreported_.messages == 0) { return false; }
    const std::uint64_t failed = behind_->failures();
    write_loss_(to, unreported_);
    if (behind_->failures() != failed) { return false; }
    unreported_ = {};
    return true;
}

void QueuedSink::report_in_kept_room(bool at_end) {
    if (!at_end && unreported_.messages <= reported_in_a_row_) { return; }
    const std::uint64_t messages = unreported_.messages;
    KeptRoom room(*behind_);
    if (!report_losses(room)) { return; }
    reported_in_a_row_ += messages;
    behind_->flush();
}

}  // namespace lockstep
