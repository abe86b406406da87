// Whatever a line does to bytes, each end has the other's words in the order of writing, each write once.
#include <gtest/gtest.h>

#include <vector>

#include "sim_fpga/firmware/link/crc32.hpp"
#include "tests/property/firmware/poor_line.hpp"

namespace lockstep::testing {
namespace {

struct Write {
    unsigned motor;
    std::size_t offset;
    std::uint64_t value;
    bool operator==(const Write&) const = default;
};

/// Sends a list of writes, and keeps those of the other end.
class ListOfWrites final : public firmware::LinkWords {
public:
    void begin() override {
        ++begun;
        sent_ = 0;
        taken.clear();
    }
    void fill(firmware::ItemWriter& items, std::uint32_t /*heard*/) override {
        for (; sent_ < writes.size() && items.has_room(1); ++sent_) {
            items.put(writes[sent_].motor, writes[sent_].offset, writes[sent_].value);
        }
    }
    void take(unsigned motor, std::size_t offset, std::uint64_t value) override {
        taken.push_back({motor, offset, value});
    }
    void open() override {}
    void close() override {}

    std::vector<Write> writes;
    std::vector<Write> taken;
    int begun = 0;

private:
    std::size_t sent_ = 0;
};

/// Is this the beginning of the other?
bool begins(const std::vector<Write>& part, const std::vector<Write>& whole) {
    return part.size() <= whole.size() && std::equal(part.begin(), part.end(), whole.begin());
}

class TwoEnds {
public:
    TwoEnds(LineFaults faults, std::uint64_t seed)
        : host_(host, 7), board_(board, 8), there_(faults, seed), back_(faults, ~seed), random_(seed) {}

    void run(std::uint32_t until_us, bool is_writing) {
        for (; now_us_ < until_us; now_us_ += 50) {
            if (is_writing && random_() % 8 == 0) { write(host); }
            if (is_writing && random_() % 8 == 0) { write(board); }
            there_.advance(host_, board_, now_us_);
            back_.advance(board_, host_, now_us_);
        }
    }
    void repair() {
        there_.repair();
        back_.repair();
    }
    std::uint32_t refused() const { return host_.refused() + board_.refused(); }

    ListOfWrites host;
    ListOfWrites board;

private:
    void write(ListOfWrites& end) {
        std::size_t offset = random_() % 0x2'0000 * 8;
        for (auto left = random_() % 12; left > 0; --left, offset += 8) {
            const std::uint64_t value = random_() % 3 == 0 ? 0 : random_();
            end.writes.push_back({static_cast<unsigned>(random_() % 3), offset, value});
        }
    }

    firmware::Link host_;
    firmware::Link board_;
    PoorLine there_;
    PoorLine back_;
    std::mt19937_64 random_;
    std::uint32_t now_us_ = 0;
};

TEST(FirmwareLink, HasTheCrcOfTheStandard) {
    const std::uint8_t digits[] = {'1', '2', '3', '4', '5', '6', '7', '8', '9'};
    EXPECT_EQ(firmware::crc32(digits, sizeof digits), 0xCBF4'3926);
}

TEST(FirmwareLink, ReadsTheMessageOfAnyFrame) {
    std::mt19937_64 random(1);
    firmware::FrameReader reader;
    for (int trial = 0; trial < 20'000; ++trial) {
        firmware::Message message;
        message.size = random() % (firmware::kMostMessageBytes + 1);
        const auto zeros = random() % 4;
        for (std::size_t n = 0; n < message.size; ++n) {
            message.bytes[n] = static_cast<std::uint8_t>(random() % 4 < zeros ? 0 : random());
        }
        firmware::Frame frame;
        encode(message, frame);
        for (std::size_t n = 0; n < frame.size; ++n) {
            ASSERT_EQ(frame.bytes[n] == 0, n + 1 == frame.size);
            ASSERT_EQ(reader.take(frame.bytes[n]), n + 1 == frame.size);
        }
        ASSERT_EQ(reader.message().size, message.size);
        ASSERT_TRUE(std::equal(message.bytes, message.bytes + message.size, reader.message().bytes));
    }
    EXPECT_EQ(reader.refused(), 0U);
}

TEST(FirmwareLink, AnyBytesAreNoMessage) {
    std::mt19937_64 random(2);
    firmware::FrameReader reader;
    for (int n = 0; n < 1'000'000; ++n) {
        ASSERT_FALSE(reader.take(static_cast<std::uint8_t>(random() % 50 == 0 ? 0 : random())));
    }
    EXPECT_GT(reader.refused(), 10'000U);
}

TEST(FirmwareLink, CopiesEachWriteOnceAndInOrderOverAPoorLine) {
    constexpr LineFaults kLines[] = {
        {}, {.damaged = 10}, {.lost = 10}, {.late = 50}, {.damaged = 50, .lost = 50, .late = 50}};
    for (std::uint64_t seed = 1; seed <= 40; ++seed) {
        TwoEnds ends(kLines[seed % 5], seed);
        for (std::uint32_t until_us = 10'000; until_us <= 200'000; until_us += 10'000) {
            ends.run(until_us, true);
            ASSERT_TRUE(begins(ends.board.taken, ends.host.writes)) << "seed " << seed;
            ASSERT_TRUE(begins(ends.host.taken, ends.board.writes)) << "seed " << seed;
        }
        ends.repair();
        ends.run(2'000'000, false);
        EXPECT_EQ(ends.board.taken, ends.host.writes) << "seed " << seed;
        EXPECT_EQ(ends.host.taken, ends.board.writes) << "seed " << seed;
        EXPECT_EQ(ends.board.begun, 1);
    }
}

/// After the start of a process or a board its end of the link has another session.
TEST(FirmwareLink, BeginsAnewWhenAnEndDoes) {
    ListOfWrites host;
    ListOfWrites board;
    host.writes = {{0, 8, 1}, {1, 16, 2}};
    firmware::Link host_link(host, 9);
    PoorLine there({}, 1);
    PoorLine back({}, 2);
    std::uint32_t now_us = 0;
    for (std::uint32_t session = 1; session <= 3; ++session) {
        firmware::Link board_link(board, session);
        for (const std::uint32_t until_us = now_us + 50'000; now_us < until_us; now_us += 50) {
            there.advance(host_link, board_link, now_us);
            back.advance(board_link, host_link, now_us);
        }
        EXPECT_EQ(board.taken, host.writes);
        EXPECT_EQ(host.begun, static_cast<int>(session));
    }
}

/// A host that has missed what another one did gets all words when it is back.
TEST(FirmwareLink, BeginsAnewWithAHostThatComesBack) {
    ListOfWrites board;
    board.writes = {{0, 8, 1}, {1, 16, 2}};
    firmware::Link board_link(board, 21);
    ListOfWrites words[2];
    firmware::Link hosts[2] = {{words[0], 31}, {words[1], 33}};
    std::uint32_t now_us = 0;
    for (const int turn : {0, 1, 0}) {
        PoorLine there({}, 1);
        PoorLine back({}, 2);
        board_link.restart(21 + 2 * now_us + 2);
        words[turn].taken.clear();
        for (const std::uint32_t until_us = now_us + 50'000; now_us < until_us; now_us += 50) {
            there.advance(hosts[turn], board_link, now_us);
            back.advance(board_link, hosts[turn], now_us);
        }
        EXPECT_EQ(words[turn].taken, board.writes);
    }
}

TEST(FirmwareLink, DoesNotTakeItsOwnFramesForThoseOfTheOtherEnd) {
    ListOfWrites words;
    firmware::Link link(words, 5);
    PoorLine echo({}, 1);
    for (std::uint32_t now_us = 0; now_us < 50'000; now_us += 50) { echo.advance(link, link, now_us); }
    EXPECT_FALSE(link.is_connected());
    EXPECT_EQ(words.begun, 0);
}

}  // namespace
}  // namespace lockstep::testing
