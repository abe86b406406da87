// A G-code file or a pipe is read while the coordinator runs it.
#include "clients/session/program_stream.hpp"

#include <fcntl.h>
#include <gtest/gtest.h>
#include <unistd.h>

#include <fstream>

#include "services/documents/program_document.hpp"
#include "tests/temporary_directory.hpp"

namespace lockstep {
namespace {

using namespace std::chrono_literals;

GcodeSetup setup_of_two() { return {.program_name = "job", .axes = {{"X", 0, 200, 0, 0}, {"Y", 0, 200, 0, 0}}}; }

class Reading : public testing::Test {
protected:
    std::string file(const std::string& text) {
        const std::string path = (directory.path() / "job.gcode").string();
        std::ofstream(path) << text;
        return path;
    }
    static ProgramStream stream_of(const std::string& path) {
        return {LineReader::open(path).value(), setup_of_two(), 3};
    }
    /// The program that a coordinator with plenty of room receives.
    static ProgramDocument sent(ProgramStream& stream) {
        ProgramSender sender(7, 1, 42, stream.head(), stream.values());
        std::vector<std::uint8_t> bytes;
        for (std::uint32_t parts = 0; !sender.is_done();) {
            stream.feed(sender, 0ns);
            std::uint64_t newest = 0;
            for (const ProgramChunk& chunk : sender.due(0ns)) {
                bytes.insert(bytes.end(), chunk.bytes.begin(), chunk.bytes.end());
                newest = chunk.sequence;
                ++parts;
            }
            (void)sender.take_answer({.client = 7, .sequence = newest, .parts = parts, .free_blocks = 1'000'000});
        }
        return program_document_from_bytes(bytes).value();
    }
    static std::string many_lines(int count) {
        std::string text = "G21 G90 G1 F600\n";
        for (int k = 0; k < count; ++k) { text += "X" + std::to_string(k % 150) + " Y" + std::to_string(k % 7) + "\n"; }
        return text;
    }

    TemporaryDirectory directory;
};

TEST_F(Reading, SendsWhatReadingAsAWholeMakes) {
    const std::string text =
        many_lines(5000) + "G1 X30 Y30\nG2 X40 Y30 I5 J0\nG4 P0.5\nM0\nG28\nM2\nnonsense behind the end\n";
    ProgramStream stream = stream_of(file(text));
    ASSERT_TRUE(stream.read_first());
    const ProgramDocument document = sent(stream);
    const auto whole = read_gcode(text, setup_of_two());
    ASSERT_TRUE(whole);
    EXPECT_EQ(program_bytes(document.program), program_bytes(whole->program));
    EXPECT_EQ(document.cut, "");
    EXPECT_EQ(document.values->revision, 3u);
}

TEST_F(Reading, RefusesAnErrorInTheFirstLinesBeforeAnythingMoves) {
    ProgramStream stream = stream_of(file("G21 G90 F600\nG1 X10\nG1 X300\n"));
    const auto read = stream.read_first();
    ASSERT_FALSE(read);
    EXPECT_EQ(read.error().front().line, 3);
}

TEST_F(Reading, EndsBeforeALaterLineThatIsWrong) {
    const int lines = static_cast<int>(ProgramStream::kLinesFirst) + 5000;
    ProgramStream stream = stream_of(file(many_lines(lines) + "G1 X10 nonsense\nG1 X20\n"));
    ASSERT_TRUE(stream.read_first());
    const ProgramDocument document = sent(stream);
    EXPECT_EQ(document.program.blocks.back().line, lines + 1);
    ASSERT_TRUE(stream.trouble());
    EXPECT_EQ(stream.trouble()->line, lines + 2);
    EXPECT_NE(document.cut.find("line " + std::to_string(lines + 2)), std::string::npos) << document.cut;
}

TEST_F(Reading, EndsWhereAFileHasBecomeShorter) {
    const int lines = static_cast<int>(ProgramStream::kLinesFirst) + 200'000;
    const std::string path = file(many_lines(lines));
    ProgramStream stream = stream_of(path);
    ASSERT_TRUE(stream.read_first());
    std::filesystem::resize_file(path, 1'500'000);
    const ProgramDocument document = sent(stream);
    EXPECT_NE(document.cut.find("shorter"), std::string::npos) << document.cut;
    EXPECT_GT(document.program.blocks.size(), ProgramStream::kLinesFirst);
}

TEST_F(Reading, GoesOnFromALineWithTheMovesBeforeIt) {
    ProgramStream stream = stream_of(file(many_lines(5000)));
    const auto beginning = stream.skip_before(3000);
    ASSERT_TRUE(beginning);
    ASSERT_GE(beginning->program.blocks.size(), 3u);
    EXPECT_EQ(beginning->program.blocks[1].line, 2999);
    EXPECT_EQ(beginning->program.blocks[2].line, 3000);
    ASSERT_TRUE(beginning->modal.feed_mm_min);
    EXPECT_EQ(*beginning->modal.feed_mm_min, 600);
}

TEST_F(Reading, APipeThatIsSilentSettles) {
    int ends[2];
    ASSERT_EQ(pipe(ends), 0);
    const std::string text = "G21 G90 G1 F600\nX10\nX20\n";
    ASSERT_EQ(write(ends[1], text.data(), text.size()), static_cast<ssize_t>(text.size()));
    ProgramStream stream = stream_of("/proc/self/fd/" + std::to_string(ends[0]));
    ASSERT_TRUE(stream.read_first());
    ProgramSender sender(7, 1, 42, stream.head());
    stream.feed(sender, 0ns);
    const auto first = sender.due(0ns);
    ASSERT_EQ(first.size(), 1u) << "what came is sent at once";
    EXPECT_EQ(program_from_bytes(first[0].bytes)->blocks.size(), 2u);
    (void)sender.take_answer({.client = 7, .sequence = first[0].sequence, .parts = 1, .free_blocks = 1000});
    stream.feed(sender, 100ms);
    EXPECT_TRUE(sender.due(100ms).empty());
    stream.feed(sender, 250ms);
    const auto settle = sender.due(250ms);
    ASSERT_EQ(settle.size(), 1u);
    const auto part = program_document_from_bytes(settle[0].bytes, 2);
    ASSERT_TRUE(part);
    ASSERT_EQ(part->program.blocks.size(), 1u);
    EXPECT_TRUE(std::holds_alternative<Settle>(part->program.blocks[0].action));
    (void)sender.take_answer({.client = 7, .sequence = settle[0].sequence, .parts = 2, .free_blocks = 1000});
    stream.feed(sender, 9s);
    EXPECT_FALSE(sender.is_ended());
    close(ends[1]);
    stream.feed(sender, 10s);
    EXPECT_TRUE(sender.is_ended());
    close(ends[0]);
}

class ReadingProbes : public Reading {
protected:
    ProgramStream stream_with(const std::string& text) {
        GcodeSetup setup = setup_of_two();
        setup.inputs = {{.name = "plate", .motor = "X", .use = InputUse::Probe, .number = 0}};
        return {LineReader::open(file(text)).value(), setup, 3};
    }
};

TEST_F(ReadingProbes, AProgramIsDividedBehindEachProbingMove) {
    ProgramStream stream = stream_with("G38.2 X50 F60\nG10 L2 P1 X1\nG0 X[#5061+2]\nG38.3 X60\n");
    ASSERT_TRUE(stream.read_first());
    const ProgramDocument first = sent(stream);
    EXPECT_EQ(first.program.blocks.size(), 2u);
    EXPECT_EQ(first.cut, "");
    ASSERT_TRUE(stream.awaits_touch());

    ASSERT_TRUE(stream.touched({.touched = true, .places_mm = {20, 0}, .rest_mm = {20.5, 0}}, 4));
    EXPECT_FALSE(stream.is_empty());
    EXPECT_TRUE(stream.changes_values());
    const ProgramDocument second = sent(stream);
    EXPECT_EQ(second.program.start_mm, (std::vector<double>{20.5, 0}));
    EXPECT_EQ(std::get<ProgramMove>(second.program.blocks[0].action).target_mm[0], 23);
    EXPECT_EQ(second.values->revision, 4u);
    EXPECT_EQ(second.values->after->systems[0].origin[0], 1);

    ASSERT_TRUE(stream.touched({.touched = false, .places_mm = {61, 0}, .rest_mm = {61, 0}}, 5));
    EXPECT_TRUE(stream.is_empty()) << "nothing follows the last probing move";
}

TEST_F(ReadingProbes, TellAnErrorBehindATouchBeforeAnythingElseMoves) {
    ProgramStream stream = stream_with("G38.2 X50 F60\nG0 X[#5061+170]\n");
    ASSERT_TRUE(stream.read_first());
    (void)sent(stream);
    const auto read = stream.touched({.touched = true, .places_mm = {40, 0}, .rest_mm = {41, 0}}, 3);
    ASSERT_FALSE(read);
    EXPECT_EQ(read.error().front().line, 2);
}

TEST_F(ReadingProbes, RefuseARestartBehindAProbingMove) {
    ProgramStream stream = stream_with("G0 X1\nG38.2 X50 F60\nG0 X2\nG0 X3\n");
    const auto beginning = stream.skip_before(4);
    ASSERT_FALSE(beginning);
    EXPECT_EQ(beginning.error().front().line, 2);
}

}  // namespace
}  // namespace lockstep
