// If the disk is slow, the log loses messages and lists the losses. The disk never delays the writer.
#include "services/record/queued_sink.hpp"

#include <gtest/gtest.h>

#include <algorithm>
#include <future>
#include <vector>

#include "tests/unit/allocations/counted_allocations.hpp"

namespace lockstep {
namespace {

struct Disk {
    std::promise<void> opens;
    std::shared_future<void> open{opens.get_future()};
    std::atomic<bool> is_full = false;
    std::atomic<bool> is_busy = false;  // with writing a message
    std::vector<std::int64_t> written;  // utimes
    std::vector<RecordLoss> losses;
    std::vector<std::size_t> losses_at;  // how many messages were written before each loss
};

/// Each write waits until the disk is open.
class DiskSink : public RecordSink {
public:
    explicit DiskSink(Disk& disk) : disk_(disk) {}
    void write(const std::string&, std::int64_t utime, std::span<const std::uint8_t>) override {
        disk_.is_busy = true;
        disk_.open.wait();
        if (disk_.is_full) {
            ++failures_;
        } else {
            disk_.written.push_back(utime);
        }
    }
    std::uint64_t failures() const override { return failures_; }

private:
    Disk& disk_;
    std::uint64_t failures_ = 0;
};

class SinkQueue : public testing::Test {
protected:
    void begin(std::size_t queue_bytes) {
        sink = std::make_unique<QueuedSink>(
            std::make_unique<DiskSink>(disk),
            [this](RecordSink&, const RecordLoss& loss) {
                disk.losses.push_back(loss);
                disk.losses_at.push_back(disk.written.size());
            },
            "MARK", queue_bytes);
    }
    void write(std::int64_t utime) { sink->write("C", utime, std::vector<std::uint8_t>(100)); }
    /// Writes messages, each later by 1, until this holds. The sink keeps a message that came while its thread took the
    /// queue until the next one comes, so one message alone may not reach the disk. Returns the next message's time.
    template <typename Condition>
    std::int64_t write_until(Condition holds) {
        std::int64_t next = 0;
        for (; !holds(); std::this_thread::sleep_for(5 * QueuedSink::kPeriod)) { write(next++); }
        return next;
    }
    void end() { sink.reset(); }

    Disk disk;
    std::unique_ptr<QueuedSink> sink;
};

TEST_F(SinkQueue, KeepsEveryMessageInItsOrder) {
    begin(1 << 20);
    disk.opens.set_value();
    for (std::int64_t i = 0; i < 1000; ++i) { write(i); }
    end();
    ASSERT_EQ(disk.written.size(), 1000U);
    EXPECT_TRUE(std::ranges::is_sorted(disk.written));
    EXPECT_TRUE(disk.losses.empty());
}

TEST_F(SinkQueue, NeverMakesAWriterWaitForADiskThatHangs) {
    begin(2000);
    std::int64_t next = write_until([this] { return disk.is_busy.load(); });  // the thread waits for the disk
    for (; next < 1000; ++next) { write(next); }                              // would never end if write() waited
    const std::uint64_t lost = sink->failures();
    EXPECT_GT(lost, 900U);
    disk.opens.set_value();
    end();
    EXPECT_EQ(disk.written.size() + lost, 1000U);
    ASSERT_EQ(disk.losses.size(), 1U) << "recorded once, where they are missing";
    EXPECT_EQ(disk.losses[0].messages, lost);
    EXPECT_EQ(disk.losses[0].first_utime, disk.written.back() + 1);
    EXPECT_EQ(disk.losses[0].last_utime, 999);
    EXPECT_EQ(disk.losses_at[0], disk.written.size());
}

TEST_F(SinkQueue, AllocatesNothingForTheCallerWhileMessagesOfTwoSecondsWait) {
    begin(QueuedSink::kQueueBytes);
    std::int64_t next = write_until([this] { return disk.is_busy.load(); });
    const std::string channel = "C";
    const std::vector<std::uint8_t> message(100);
    const std::uint64_t before = CountedAllocations::count();
    {
        const CountedAllocations counted;
        for (std::size_t bytes = 0; bytes < QueuedSink::kReserved_bytes - 4096; bytes += 128) {
            sink->write(channel, next++, message);
        }
    }
    EXPECT_EQ(CountedAllocations::count(), before) << CountedAllocations::places();
    disk.opens.set_value();
    end();
    EXPECT_EQ(disk.written.size(), static_cast<std::size_t>(next));
}

TEST_F(SinkQueue, ReportsMessagesThatAFullDiskRefused) {
    begin(1 << 20);
    disk.is_full = true;
    disk.opens.set_value();
    const std::int64_t last = write_until([this] { return sink->failures() >= 2; });
    disk.is_full = false;
    write(last);
    end();
    std::uint64_t reported = 0;
    for (const RecordLoss& loss : disk.losses) { reported += loss.messages; }
    EXPECT_GE(reported, 2U);
    ASSERT_LE(reported, static_cast<std::uint64_t>(last)) << "the last message is written";
    std::vector<std::int64_t> others;
    for (auto i = static_cast<std::int64_t>(reported); i <= last; ++i) { others.push_back(i); }
    EXPECT_EQ(disk.written, others);
}

/// A full disk, except for the space reserved for loss messages.
class FullSink : public RecordSink {
public:
    explicit FullSink(std::vector<std::string>& kept) : kept_(kept) {}
    void write(const std::string&, std::int64_t, std::span<const std::uint8_t>) override { ++failures_; }
    void write_kept(const std::string& channel, std::int64_t, std::span<const std::uint8_t> bytes) override {
        kept_.push_back(channel + " " + std::to_string(bytes.size()));
    }
    std::uint64_t failures() const override { return failures_; }

private:
    std::vector<std::string>& kept_;
    std::uint64_t failures_ = 0;
};

TEST(FullDisk, ALossIsRecordedInReservedSpaceWhenItDoublesAndAtTheEnd) {
    constexpr std::uint64_t kMessages = 1000;
    std::vector<std::string> kept;
    std::uint64_t reported = 0;
    std::size_t largest_mark = 0;
    {
        QueuedSink sink(
            std::make_unique<FullSink>(kept),
            [&](RecordSink& log, const RecordLoss& loss) {
                const std::size_t before = kept.size();
                log.write("LOSS", loss.last_utime, std::vector<std::uint8_t>(8));
                if (kept.size() == before) { return; }
                reported += loss.messages;
                largest_mark = std::max(largest_mark, loss.mark.size());
            },
            "MARK", 1 << 20);
        for (std::uint64_t i = 0; i < kMessages; ++i) {
            sink.write("STEPS", static_cast<std::int64_t>(i), std::vector<std::uint8_t>(100));
            if (i % 100 == 0) { std::this_thread::sleep_for(QueuedSink::kPeriod * 2); }
        }
        sink.write("MARK", kMessages, std::vector<std::uint8_t>(77));
    }
    EXPECT_EQ(reported, kMessages + 1) << "at the end every loss is recorded";
    EXPECT_LE(kept.size(), 14U) << "however many messages are lost";
    EXPECT_EQ(largest_mark, 77U) << "with the process's published counts";
}

}  // namespace
}  // namespace lockstep
