// A program of any length is read from its log block by block. An unreadable program is an error.
#include "services/record/reading/recorded_program.hpp"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include "services/documents/program_document.hpp"
#include "services/record/reading/log_read.hpp"
#include "services/wire/lcm/lcm_channels.hpp"
#include "tests/unit/analysis/log_makers.hpp"

namespace lockstep::analysis {
namespace {

using testing::ElementsAre;
using testing::HasSubstr;

constexpr std::uint32_t kBlocks = 60'000;  // more blocks than the reader of a log keeps in memory

/// Moves along X, with an event or a dwell now and then.
Program long_program() {
    Program program{.name = "long.gcode", .axes = {"X", "Y"}, .start_mm = {1, 2}, .blocks = {}};
    for (std::uint32_t k = 0; k < kBlocks; ++k) {
        Block block{.line = static_cast<std::int32_t>(k + 1), .action = Dwell{0.1}};
        if (k % 1000 == 7) {
            block.action = ProgramEvent{ProgramEvent::Kind::FloodOn, static_cast<std::int32_t>(k), 0};
        } else if (k % 10 != 3) {
            block.action = ProgramMove{.target_mm = {k * 0.01, 2}, .feed_mm_s = 10};
        }
        program.blocks.push_back(std::move(block));
    }
    return program;
}

class RecordedProgramTest : public testing::Test {
protected:
    const std::filesystem::path path = test::test_directory() / "program.lcm";

    /// Writes the program in parts of whole blocks, or in parts cut anywhere.
    void write(const Program& program, bool cut_anywhere) const {
        auto log = LogWriter::open(path);
        std::vector<std::vector<std::uint8_t>> parts;
        if (cut_anywhere) {
            const auto bytes = program_bytes(program);
            for (std::size_t at = 0; at < bytes.size(); at += 10'001) {
                const auto end = std::min(bytes.size(), at + 10'001);
                parts.emplace_back(bytes.begin() + static_cast<std::ptrdiff_t>(at),
                                   bytes.begin() + static_cast<std::ptrdiff_t>(end));
            }
        } else {
            ProgramPartWriter writer(program.head());
            for (const Block& block : program.blocks) {
                writer.add(block);
                if (writer.is_full()) { parts.push_back(writer.take()); }
            }
            parts.push_back(writer.take());
        }
        for (std::size_t k = 0; k < parts.size(); ++k) {
            program_part_t part{};
            part.machine = "mill";
            part.program = 5;
            part.part = static_cast<std::int32_t>(k);
            part.parts = static_cast<std::int32_t>(parts.size());
            part.size = static_cast<std::int32_t>(parts[k].size());
            part.data = parts[k];
            log->write_message(program_channel("mill"), 1, part);
        }
        log->flush();
    }

    ProgramPlaces places() const {
        ProgramPlaces places{.log = path, .offsets = {}};
        auto reader = LogReader::open(path);
        while (const auto event = reader->next().value()) { places.offsets.push_back(event->offset); }
        return places;
    }
};

TEST_F(RecordedProgramTest, HasEveryBlockInAnyOrder) {
    const Program whole = long_program();
    for (const bool cut_anywhere : {false, true}) {
        SCOPED_TRACE(cut_anywhere);
        write(whole, cut_anywhere);
        const auto program = RecordedProgram::open(places());
        ASSERT_TRUE(program) << program.error();
        EXPECT_EQ((*program)->head().name, "long.gcode");
        EXPECT_THAT((*program)->axes(), ElementsAre("X", "Y"));
        ASSERT_EQ((*program)->size(), kBlocks);
        EXPECT_EQ((*program)->events().size(), kBlocks / 1000);
        const WholeProgram expected(std::make_shared<const Program>(whole));
        for (std::uint32_t k = 0; k < kBlocks; ++k) {
            const std::uint32_t number = k % 2 == 0 ? k : kBlocks - k;  // consecutive numbers are far apart
            const Block* block = (*program)->block(number);
            ASSERT_NE(block, nullptr);
            EXPECT_EQ(block->line, static_cast<std::int32_t>(number + 1));
            EXPECT_EQ(block->action.index(), whole.blocks[number].action.index());
            if (k % 97 != 0) { continue; }
            EXPECT_EQ((*program)->place_before(number)->front(), expected.place_before(number)->front()) << number;
        }
        EXPECT_EQ((*program)->block(kBlocks), nullptr);
        EXPECT_TRUE((*program)->ends_before(kBlocks));
        EXPECT_EQ((*program)->place_before(kBlocks)->front(), (kBlocks - 1) * 0.01);
    }
}

TEST_F(RecordedProgramTest, OneThatCannotBeReadIsAnError) {
    write(long_program(), false);
    ProgramPlaces wrong = places();
    wrong.offsets[3] += 5;
    const auto program = RecordedProgram::open(wrong);
    ASSERT_FALSE(program);
    EXPECT_THAT(program.error(), HasSubstr("no longer has a part of a program at byte"));
    wrong.log = "nowhere.lcm";
    EXPECT_FALSE(RecordedProgram::open(wrong));
}

/// The first part of the program comes twice. Only the first part may name axes.
TEST_F(RecordedProgramTest, PartsOfSeveralProgramsAreAnError) {
    write(long_program(), false);
    ProgramPlaces twice = places();
    twice.offsets.push_back(twice.offsets.front());
    EXPECT_FALSE(RecordedProgram::open(twice)) << "a later part names axes";
}

TEST_F(RecordedProgramTest, ALogThatShrinksIsNoted) {
    write(long_program(), false);
    const auto program = RecordedProgram::open(places());
    ASSERT_TRUE(program) << program.error();
    std::filesystem::resize_file(path, 100);
    EXPECT_EQ((*program)->block(0), nullptr);
    EXPECT_TRUE((*program)->failure());
}

}  // namespace
}  // namespace lockstep::analysis
