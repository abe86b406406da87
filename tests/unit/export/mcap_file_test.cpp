// An MCAP file has chunks with message indexes, and a summary from which a reader finds messages by time and topic.
#include "clients/export/mcap_file.hpp"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <fstream>
#include <sstream>

#include "tests/unit/export/mcap_reader.hpp"

namespace lockstep::exporting {
namespace {

using testing::ElementsAre;
using testing::HasSubstr;
using testing::Key;
using testing::Pair;
using testing::SizeIs;

constexpr std::size_t kMagicBytes = 8;

enum Kind { kHeader = 1, kFooter = 2, kSchema, kChannel, kMessage, kChunk, kMessageIndex, kChunkIndex };
enum LaterKind { kStatistics = 11, kSummaryOffset = 14, kDataEnd = 15 };

Sample sample(const std::string& topic, std::int64_t utime, double value) {
    return {topic, utime, {{"position_mm", value}, {"state", std::string("Cruise")}}};
}

class McapStructure : public testing::Test {
protected:
    McapStructure() { std::filesystem::create_directories(path.parent_path()); }

    void write(const std::vector<Sample>& samples) {
        auto file = McapFile::create(path).value();
        for (const Sample& each : samples) { file.write(each); }
        const auto closed = file.close();
        ASSERT_TRUE(closed) << closed.error();
        left_out = file.left_out();
        std::ostringstream text;
        text << std::ifstream(path, std::ios::binary).rdbuf();
        bytes = text.str();
        ASSERT_EQ(bytes.substr(0, kMagicBytes), "\x89MCAP0\r\n");
        ASSERT_EQ(bytes.substr(bytes.size() - kMagicBytes), "\x89MCAP0\r\n");
        all = records_of(std::string_view(bytes).substr(0, bytes.size() - kMagicBytes), kMagicBytes);
        ASSERT_EQ(all.front().kind, kHeader);
        ASSERT_EQ(all.back().kind, kFooter);
        FieldReader footer = all.back().read();
        summary_begin = footer.u64();
        offsets_begin = footer.u64();
        summary_crc = static_cast<std::uint32_t>(footer.u32());
        std::ranges::copy_if(all, std::back_inserter(summary), [&](const auto& r) { return r.at >= summary_begin; });
    }
    /// So many samples of X and, after each, one of Y, 1 ms apart.
    static std::vector<Sample> many(int count) {
        std::vector<Sample> samples;
        for (int i = 0; i < count; ++i) {
            samples.push_back(sample("/mill/X/position", 1000 * i, i));
            samples.push_back(sample("/mill/Y/position", 1000 * i, -i));
        }
        return samples;
    }

    std::filesystem::path path = std::filesystem::path(testing::TempDir()) / "lockstep_mcap" /
                                 testing::UnitTest::GetInstance()->current_test_info()->name();
    std::string bytes;
    std::vector<McapRecordRead> all;
    std::vector<McapRecordRead> summary;
    std::uint64_t summary_begin = 0;
    std::uint64_t offsets_begin = 0;
    std::uint32_t summary_crc = 0;
    std::int64_t left_out = 0;
};

TEST_F(McapStructure, SummaryFollowsTheDataAndRepeatsSchemasAndChannels) {
    write({sample("/mill/X/position", 1, 1), sample("/mill/Y/position", 1, 2), sample("/mill/job", 1, 3)});
    ASSERT_FALSE(summary.empty());
    EXPECT_EQ(std::prev(all.end(), static_cast<std::ptrdiff_t>(summary.size()) + 1)->kind, kDataEnd);
    EXPECT_EQ(summary.front().at, summary_begin);
    const auto within = records_of(of_kind(all, kChunk).at(0).fields.substr(40));
    for (const int kind : {kSchema, kChannel}) {
        std::vector<std::string_view> in_chunk;
        std::vector<std::string_view> in_summary;
        for (const auto& record : of_kind(within, kind)) { in_chunk.push_back(record.fields); }
        for (const auto& record : of_kind(summary, kind)) { in_summary.push_back(record.fields); }
        EXPECT_EQ(in_chunk, in_summary);
    }
    std::map<std::string, std::uint64_t> schema_of_topic;
    for (const auto& record : of_kind(summary, kChannel)) {
        FieldReader channel = record.read();
        (void)channel.u16();
        const std::uint64_t schema = channel.u16();
        schema_of_topic[channel.text()] = schema;
        EXPECT_EQ(channel.text(), "json");
    }
    EXPECT_THAT(schema_of_topic,
                ElementsAre(Pair("/mill/X/position", 1), Pair("/mill/Y/position", 1), Pair("/mill/job", 2)));
}

TEST_F(McapStructure, StatisticsCountMessagesOfEachChannelAndGiveTheTimesOfTheFile) {
    write({sample("/mill/X/position", 5, 1), sample("/mill/X/position", 3, 2), sample("/mill/Y/position", 4, 3),
           sample("/mill/Y/position", -1, 4)});
    EXPECT_EQ(left_out, 1) << "times before 0 cannot be represented";
    const auto found = of_kind(summary, kStatistics);
    ASSERT_THAT(found, SizeIs(1));
    FieldReader statistics = found[0].read();
    EXPECT_EQ(statistics.u64(), 3U) << "messages";
    EXPECT_EQ(statistics.u16(), 1U) << "schemas";
    EXPECT_EQ(statistics.u32(), 2U) << "channels";
    EXPECT_EQ(statistics.u32(), 0U) << "attachments";
    EXPECT_EQ(statistics.u32(), 0U) << "metadata";
    EXPECT_EQ(statistics.u32(), 1U) << "chunks";
    EXPECT_EQ(statistics.u64(), 3000U) << "the first, ns";
    EXPECT_EQ(statistics.u64(), 5000U) << "the last, ns";
    EXPECT_THAT(statistics.map(), ElementsAre(Pair(1, 2), Pair(2, 1)));
    EXPECT_TRUE(statistics.is_at_end());
}

TEST_F(McapStructure, ChunksAreLimitedInSizeHoweverLongTheFile) {
    write(many(20'000));
    const auto chunks = of_kind(all, kChunk);
    ASSERT_GE(chunks.size(), 3U);
    for (const auto& chunk : chunks) { EXPECT_LT(chunk.size(), McapChunk::kFullBytes + 1000); }
}

TEST_F(McapStructure, EachChunkIndexLeadsToItsChunkAndItsMessageIndexes) {
    write(many(20'000));
    const auto chunks = of_kind(all, kChunk);
    const auto indexes = of_kind(summary, kChunkIndex);
    ASSERT_EQ(indexes.size(), chunks.size());
    for (std::size_t i = 0; i < chunks.size(); ++i) {
        FieldReader index = indexes[i].read();
        FieldReader chunk = chunks[i].read();
        EXPECT_EQ(index.u64(), chunk.u64()) << "first time";
        EXPECT_EQ(index.u64(), chunk.u64()) << "last time";
        EXPECT_EQ(index.u64(), chunks[i].at);
        EXPECT_EQ(index.u64(), chunks[i].size());
        const auto places = index.map();
        EXPECT_THAT(places, ElementsAre(Key(1), Key(2)));
        std::uint64_t lengths = 0;
        for (const auto& [channel, at] : places) {
            const auto found = std::ranges::find(all, at, &McapRecordRead::at);
            ASSERT_NE(found, all.end());
            EXPECT_EQ(found->kind, kMessageIndex);
            EXPECT_EQ(found->read().u16(), channel);
            lengths += found->size();
        }
        EXPECT_EQ(index.u64(), lengths);
        EXPECT_EQ(index.text(), "") << "no compression";
        const std::uint64_t size = chunk.u64();
        EXPECT_EQ(index.u64(), size);
        EXPECT_EQ(index.u64(), size);
        EXPECT_TRUE(index.is_at_end());
    }
}

TEST_F(McapStructure, MessageIndexesLeadToEveryMessageOfTheirChannel) {
    write(many(10'000));
    std::uint64_t messages = 0;
    std::string_view chunk;
    for (const auto& record : all) {
        if (record.kind == kChunk) { chunk = record.fields.substr(40); }
        if (record.kind != kMessageIndex) { continue; }
        FieldReader index = record.read();
        const std::uint64_t channel = index.u16();
        for (FieldReader entries(index.bytes(index.u32())); !entries.is_at_end(); ++messages) {
            const std::uint64_t time_ns = entries.u64();
            FieldReader head(chunk.substr(entries.u64()));
            ASSERT_EQ(head.number(1), kMessage);
            FieldReader message(head.bytes(head.u64()));
            ASSERT_EQ(message.u16(), channel);
            (void)message.u32();
            ASSERT_EQ(message.u64(), time_ns);
        }
    }
    EXPECT_EQ(messages, 20'000U);
}

TEST_F(McapStructure, TimesOfAChunkContainMessagesThatCameOutOfOrder) {
    write({sample("/mill/X/position", 7, 1), sample("/mill/X/position", 2, 2), sample("/mill/X/position", 4, 3)});
    FieldReader chunk = of_kind(all, kChunk).at(0).read();
    EXPECT_EQ(chunk.u64(), 2000U);
    EXPECT_EQ(chunk.u64(), 7000U);
}

TEST_F(McapStructure, SummaryOffsetsNameEveryGroupOfTheSummary) {
    write(many(20'000));
    std::map<std::uint64_t, std::pair<std::uint64_t, std::uint64_t>> groups;  // kind: place, length
    for (const auto& record : summary) {
        if (record.at >= offsets_begin) { continue; }
        auto& [at, length] = groups.try_emplace(record.kind, record.at, 0).first->second;
        EXPECT_EQ(at + length, record.at) << "a group is in one piece";
        length += record.size();
    }
    EXPECT_THAT(groups, ElementsAre(Key(kSchema), Key(kChannel), Key(kChunkIndex), Key(kStatistics)));
    std::map<std::uint64_t, std::pair<std::uint64_t, std::uint64_t>> named;
    for (const auto& record : of_kind(summary, kSummaryOffset)) {
        FieldReader offset = record.read();
        const std::uint64_t kind = offset.number(1);
        const std::uint64_t at = offset.u64();
        named[kind] = {at, offset.u64()};
        EXPECT_GE(record.at, offsets_begin);
    }
    EXPECT_EQ(named, groups);
}

TEST_F(McapStructure, ChecksumsCoverTheChunksTheDataAndTheSummary) {
    static_assert(Crc32().add("123456789").value() == 0xCBF43926);
    write(many(10'000));
    for (const auto& record : of_kind(all, kChunk)) {
        FieldReader chunk = record.read();
        (void)chunk.bytes(24);
        EXPECT_EQ(chunk.u32(), slow_crc32(record.fields.substr(40)));
    }
    const auto data_end = of_kind(all, kDataEnd).at(0);
    EXPECT_EQ(data_end.read().u32(), slow_crc32(std::string_view(bytes).substr(0, data_end.at)));
    const std::size_t crc_at = bytes.size() - kMagicBytes - 4;
    EXPECT_EQ(summary_crc, slow_crc32(std::string_view(bytes).substr(summary_begin, crc_at - summary_begin)));
}

TEST_F(McapStructure, FileWithoutMessagesHasStatisticsOfNone) {
    write({});
    EXPECT_THAT(of_kind(all, kChunk), SizeIs(0));
    ASSERT_THAT(of_kind(summary, kStatistics), SizeIs(1));
    EXPECT_EQ(of_kind(summary, kStatistics)[0].read().u64(), 0U);
    EXPECT_THAT(of_kind(summary, kSummaryOffset), SizeIs(1));
}

TEST(McapFile, FullDiskIsAnErrorThatNamesTheFile) {
    auto file = McapFile::create("/dev/full").value();
    for (int i = 0; i < 20'000; ++i) { file.write(sample("/mill/X/position", i, i)); }
    const auto closed = file.close();
    ASSERT_FALSE(closed);
    EXPECT_THAT(closed.error(), HasSubstr("/dev/full: not written completely: No space left on device"));
}

}  // namespace
}  // namespace lockstep::exporting
