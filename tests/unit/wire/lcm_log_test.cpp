// A log is read to its end despite any damage. Missing parts are reported.
#include "services/wire/lcm/lcm_log.hpp"

#include <gtest/gtest.h>
#include <unistd.h>

#include <random>

namespace lockstep {
namespace {

namespace fs = std::filesystem;
using Bytes = std::vector<std::uint8_t>;

class LcmLog : public testing::Test {
protected:
    ~LcmLog() override { fs::remove(path_); }

    /// A log of `count` events; event i has i + 10 bytes of value i and came at i * 1000 us.
    Bytes log_of(int count) {
        {
            auto writer = LogWriter::open(path_);
            for (int i = 0; i < count; ++i) {
                const Bytes data(static_cast<std::size_t>(i) + 10, static_cast<std::uint8_t>(i));
                EXPECT_TRUE(writer->write("CHANNEL_" + std::to_string(i), i * 1000, data));
            }
            EXPECT_TRUE(writer->flush());
        }
        std::ifstream file(path_, std::ios::binary);
        return Bytes(std::istreambuf_iterator<char>(file), {});
    }

    /// Where event i of log_of() begins.
    static std::size_t offset_of(int i) {
        std::size_t offset = 0;
        for (int k = 0; k < i; ++k) {
            offset += 28 + ("CHANNEL_" + std::to_string(k)).size() + static_cast<std::size_t>(k) + 10;
        }
        return offset;
    }

    struct Read {
        std::vector<std::int64_t> numbers;
        std::vector<LogDamage> damages;
        std::uint64_t damaged_bytes = 0;
    };

    Read read(const Bytes& bytes) {
        std::ofstream(path_, std::ios::binary)
            .write(reinterpret_cast<const char*>(bytes.data()), static_cast<std::streamsize>(bytes.size()));
        auto reader = LogReader::open(path_);
        Read result;
        while (auto event = reader->next().value()) { result.numbers.push_back(event->number); }
        result.damages = reader->damages();
        result.damaged_bytes = reader->damaged_bytes();
        return result;
    }

    fs::path path_ = fs::temp_directory_path() / ("lockstep_log_test_" + std::to_string(getpid()));
};

using Numbers = std::vector<std::int64_t>;

TEST_F(LcmLog, GivesBackWhatWasWritten) {
    log_of(3);
    auto reader = LogReader::open(path_);
    ASSERT_TRUE(reader) << reader.error();
    for (int i = 0; i < 3; ++i) {
        const auto event = reader->next().value();
        ASSERT_TRUE(event);
        EXPECT_EQ(event->offset, offset_of(i));
        EXPECT_EQ(event->number, i);
        EXPECT_EQ(event->utime, i * 1000);
        EXPECT_EQ(event->channel, "CHANNEL_" + std::to_string(i));
        EXPECT_EQ(Bytes(event->data.begin(), event->data.end()),
                  Bytes(static_cast<std::size_t>(i) + 10, static_cast<std::uint8_t>(i)));
    }
    EXPECT_FALSE(reader->next().value());
    EXPECT_TRUE(reader->damages().empty());
}

TEST_F(LcmLog, CutAnywhereGivesAllWholeEventsAndReportsTheRest) {
    const Bytes whole = log_of(4);
    for (std::size_t length = 0; length < whole.size(); ++length) {
        const Read cut = read(Bytes(whole.begin(), whole.begin() + static_cast<std::ptrdiff_t>(length)));
        std::size_t expected = 0;
        while (offset_of(static_cast<int>(expected) + 1) <= length) { ++expected; }
        ASSERT_EQ(cut.numbers.size(), expected) << "cut at " << length;
        ASSERT_EQ(cut.damaged_bytes, length - offset_of(static_cast<int>(expected))) << "cut at " << length;
    }
}

TEST_F(LcmLog, ADamagedHeaderCostsOneEvent) {
    for (const std::size_t at : {0u, 20u, 22u}) {  // in the sync word, in the channel's length
        Bytes bytes = log_of(5);
        bytes[offset_of(2) + at] ^= 0xFF;
        const Read damaged = read(bytes);
        EXPECT_EQ(damaged.numbers, (Numbers{0, 1, 3, 4})) << "byte " << at;
        ASSERT_EQ(damaged.damages.size(), 1u);
        EXPECT_EQ(damaged.damages[0].offset, offset_of(2));
        EXPECT_EQ(damaged.damages[0].bytes, offset_of(3) - offset_of(2));
    }
}

TEST_F(LcmLog, ALengthThatSwallowsLaterEventsCostsOneEvent) {
    Bytes bytes = log_of(8);
    bytes[offset_of(2) + 27] = 100;  // the data's length
    EXPECT_EQ(read(bytes).numbers, (Numbers{0, 1, 3, 4, 5, 6, 7}));
    bytes[offset_of(2) + 24] = 1;  // beyond the end of the file
    EXPECT_EQ(read(bytes).numbers, (Numbers{0, 1, 3, 4, 5, 6, 7}));
}

TEST_F(LcmLog, ForeignBytesAreSkipped) {
    Bytes bytes = log_of(4);
    const Bytes garbage(1000, 0xED);
    bytes.insert(bytes.begin() + static_cast<std::ptrdiff_t>(offset_of(2)), garbage.begin(), garbage.end());
    const Read read_back = read(bytes);
    EXPECT_EQ(read_back.numbers, (Numbers{0, 1, 2, 3}));
    EXPECT_EQ(read_back.damaged_bytes, 1000u);
}

TEST_F(LcmLog, AForeignFileHasNoEvents) {
    Bytes bytes(3'000'000);  // wider than the window
    std::mt19937 random(5);
    for (auto& byte : bytes) { byte = static_cast<std::uint8_t>(random()); }
    const Read foreign = read(bytes);
    EXPECT_TRUE(foreign.numbers.empty());
    EXPECT_EQ(foreign.damaged_bytes, bytes.size());
    EXPECT_TRUE(read({}).damages.empty());
}

TEST_F(LcmLog, RandomDamageLosesOnlyWhatItTouches) {
    const Bytes whole = log_of(100);
    std::mt19937 random(6);
    for (int round = 0; round < 100; ++round) {
        Bytes bytes = whole;
        const int hit = static_cast<int>(random() % 100);
        const std::size_t size = offset_of(hit + 1) - offset_of(hit);
        bytes[offset_of(hit) + random() % size] ^= static_cast<std::uint8_t>(1 + random() % 255);
        EXPECT_GE(read(bytes).numbers.size(), 99u);
    }
}

TEST_F(LcmLog, EventsAcrossTheWindowsEdgeAreWhole) {
    {
        auto writer = LogWriter::open(path_);
        for (int i = 0; i < 40; ++i) {
            EXPECT_TRUE(writer->write("BIG", i, Bytes(100'000, static_cast<std::uint8_t>(i))));
        }
        EXPECT_TRUE(writer->flush());
    }
    auto reader = LogReader::open(path_);
    for (int i = 0; i < 40; ++i) {
        const auto event = reader->next().value();
        ASSERT_TRUE(event);
        EXPECT_EQ(event->data.front(), i);
        EXPECT_EQ(event->data.back(), i);
        EXPECT_EQ(event->data.size(), 100'000u);
    }
    EXPECT_FALSE(reader->next().value());
}

TEST_F(LcmLog, AMissingFileIsAnError) {
    const auto reader = LogReader::open("/nonexistent/log");
    ASSERT_FALSE(reader);
    EXPECT_NE(reader.error().find("/nonexistent/log"), std::string::npos);
    EXPECT_FALSE(LogReader::open(fs::temp_directory_path()));
    EXPECT_FALSE(LogWriter::open("/nonexistent/log"));
}

}  // namespace
}  // namespace lockstep
