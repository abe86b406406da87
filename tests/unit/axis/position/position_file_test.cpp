// The file with the position of an axis is read as it was written, or refused with the reason.
#include "services/axis/position_file.hpp"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <atomic>

#include "services/axis/position_document.hpp"
#include "services/files/text_file.hpp"

namespace lockstep {
namespace {

namespace fs = std::filesystem;
using testing::HasSubstr;

KeptPosition position_after(std::uint64_t run) {
    return {.scale = {"mill", "X", 80.1, -1.0 / 3, false, 7},
            .power_up = 0xfedcba9876543210U,
            .run = run,
            .position = Position::from_count(-1200, 0x8000000000000001U),
            .zero_count = -400,
            .encoder_zero = 3,
            .play_steps = -2};
}

class PositionFile : public testing::Test {
protected:
    void SetUp() override { fs::create_directories(folder_); }
    void TearDown() override { fs::remove_all(folder_); }

    std::string trouble() const {
        const ReadPosition read = read_position(file_);
        EXPECT_EQ(read.kept, KeptOrNot(std::unexpected(FaultCode::PositionUnreadable)));
        return read.trouble;
    }
    void write(const std::string& text) const { ASSERT_TRUE(write_text_file(file_, text)); }

    fs::path folder_ = fs::path(testing::TempDir()) / testing::UnitTest::GetInstance()->current_test_info()->name();
    fs::path file_ = folder_ / "X.textproto";
};

TEST_F(PositionFile, IsReadBitForBit) {
    write(position_text(position_after(7)));
    EXPECT_EQ(read_position(file_).kept, KeptOrNot(position_after(7)));
}

TEST_F(PositionFile, MayBeMissing) {
    EXPECT_EQ(read_position(file_).kept, KeptOrNot(std::unexpected(FaultCode::PositionNotKept)));
    EXPECT_EQ(read_position(folder_ / "no" / "folder").kept, KeptOrNot(std::unexpected(FaultCode::PositionNotKept)));
}

TEST_F(PositionFile, CutOffAnywhereIsRefused) {
    const std::string whole = position_text(position_after(7));
    for (std::size_t bytes = 0; bytes + 1 < whole.size(); ++bytes) {
        EXPECT_FALSE(position_from_text(whole.substr(0, bytes))) << bytes;
    }
    write(whole.substr(0, whole.size() / 2));
    EXPECT_THAT(trouble(), HasSubstr(file_.string()));
    write("");
    EXPECT_THAT(trouble(), HasSubstr("empty"));
}

TEST_F(PositionFile, WithAnyByteChangedIsRefusedOrSaysTheSame) {
    const std::string whole = position_text(position_after(7));
    for (std::size_t at = 0; at < whole.size(); ++at) {
        for (const char change : {'0', '9', ' ', '\x80'}) {
            std::string damaged = whole;
            damaged[at] = change;
            const auto kept = position_from_text(damaged);
            EXPECT_TRUE(!kept || *kept == position_after(7)) << damaged;
        }
    }
}

TEST_F(PositionFile, ThatOthersMayWriteOrThatIsNoFileIsRefused) {
    write(position_text(position_after(7)));
    fs::permissions(file_, fs::perms::others_write, fs::perm_options::add);
    EXPECT_THAT(trouble(), HasSubstr("other users may write it"));
    fs::remove(file_);
    fs::create_directory(file_);
    EXPECT_THAT(trouble(), HasSubstr("not a regular file"));
    fs::remove(file_);
    write(position_text(position_after(7)) + std::string(5000, '#'));
    EXPECT_THAT(trouble(), HasSubstr("more than 4096"));
}

TEST_F(PositionFile, HoldsTheNewestWhenTheKeeperHasEnded) {
    {
        PositionKeeper keeper(folder_ / "below" / "X.textproto", [](const std::string& why) { ADD_FAILURE() << why; });
        for (std::uint64_t run = 1; run <= 100; ++run) { keeper.keep(position_after(run)); }
    }
    EXPECT_EQ(read_position(folder_ / "below" / "X.textproto").kept, KeptOrNot(position_after(100)));
}

std::atomic<int> complaints;

TEST_F(PositionFile, ThatCannotBeWrittenIsReportedOnce) {
    {
        PositionKeeper keeper("/dev/null/X.textproto", [](const std::string&) { ++complaints; });
        for (std::uint64_t run = 1; run <= 3; ++run) { keeper.keep(position_after(run)); }
    }
    EXPECT_EQ(complaints, 1);
}

}  // namespace
}  // namespace lockstep
