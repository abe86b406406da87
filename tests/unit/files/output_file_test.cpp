// A file that is written part by part reports the first failure, when it is closed.
#include "services/files/output_file.hpp"

#include <gtest/gtest.h>

#include <fstream>
#include <iterator>

#include "services/files/unfinished_file.hpp"

namespace lockstep {
namespace {

TEST(OutputFile, HasAllPartsInTheirOrder) {
    const auto path = std::filesystem::path(testing::TempDir()) / "lockstep_output_file";
    auto file = OutputFile::create(path).value();
    file.write("one ");
    file.write("two");
    EXPECT_EQ(file.size(), 7U);
    ASSERT_TRUE(file.close());
    std::ifstream in(path);
    EXPECT_EQ(std::string(std::istreambuf_iterator<char>(in), {}), "one two");
}

TEST(OutputFile, ReportsTheReasonOfAFullDiskWhenItIsClosed) {
    auto file = OutputFile::create("/dev/full").value();
    file.write("one");
    EXPECT_FALSE(file.is_written());
    file.write("two");
    const auto closed = file.close();
    ASSERT_FALSE(closed);
    EXPECT_EQ(closed.error(), "/dev/full: not written completely: No space left on device");
}

TEST(OutputFile, ReportsADirectoryThatIsMissing) {
    const auto file = OutputFile::create("/nowhere/at/all");
    ASSERT_FALSE(file);
    EXPECT_EQ(file.error(), "/nowhere/at/all: cannot be written: No such file or directory");
}

TEST(UnfinishedFile, NamesTheFileInAnError) {
    const UnfinishedFile file("/tmp/plate.csv");
    EXPECT_EQ(file.named(file.unfinished().string() + ": not written"), "/tmp/plate.csv: not written");
    EXPECT_EQ(file.named("plate.lcm: not a log"), "plate.lcm: not a log");
}

}  // namespace
}  // namespace lockstep
