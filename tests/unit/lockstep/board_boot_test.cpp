// A running board is asked for its boot mode at its own line, if no other program uses it.
#include "clients/lockstep/live/board_boot.hpp"

#include <fcntl.h>
#include <gmock/gmock.h>
#include <gtest/gtest.h>
#include <stdlib.h>
#include <termios.h>

#include <fstream>
#include <optional>

#include "services/board/link_line.hpp"
#include "tests/temporary_directory.hpp"

namespace lockstep {
namespace {

using namespace std::chrono_literals;
using testing::ElementsAre;
using testing::HasSubstr;
using Drives = std::vector<std::filesystem::path>;

std::string refusal(const auto& result) { return result ? "" : result.error().errors.front().message; }

/// A terminal in the place of a board's line.
class BoardBoot : public testing::Test {
protected:
    void SetUp() override {
        ASSERT_EQ(::grantpt(board.get()), 0);
        ASSERT_EQ(::unlockpt(board.get()), 0);
        line = ::ptsname(board.get());
    }
    speed_t speed() const {
        const Descriptor end(::open(line.c_str(), O_RDWR | O_NOCTTY | O_CLOEXEC));
        termios mode{};
        EXPECT_EQ(::tcgetattr(end.get(), &mode), 0);
        return ::cfgetospeed(&mode);
    }
    std::filesystem::path put(const std::string& name) const {
        const std::filesystem::path file = directory.path() / name;
        std::filesystem::create_directories(file.parent_path());
        std::ofstream{file};
        return file;
    }

    Descriptor board{::posix_openpt(O_RDWR | O_NOCTTY | O_CLOEXEC)};
    std::filesystem::path line;
    TemporaryDirectory directory;
};

TEST_F(BoardBoot, FindsTheLinesOfBoardsWithLockstepsFirmware) {
    const auto one = put("serial/by-id/usb-Lockstep_Motor_board_E66138-if00");
    put("serial/by-id/usb-FTDI_FT232R_USB_UART_A5-if00-port0");
    EXPECT_THAT(lockstep_lines(directory.path()), ElementsAre(one));
    EXPECT_EQ(only_line({one}), one);
    EXPECT_THAT(refusal(only_line({})), HasSubstr("BOOTSEL"));
    EXPECT_THAT(refusal(only_line({one, line})), HasSubstr("--line"));
    EXPECT_TRUE(lockstep_lines(directory.path() / "none").empty());
}

TEST_F(BoardBoot, ClosesTheLineAt1200Baud) {
    const Descriptor end(::open(line.c_str(), O_RDWR | O_NOCTTY | O_CLOEXEC));
    ASSERT_TRUE(ask_for_boot_mode(line));
    EXPECT_EQ(speed(), speed_t{B1200});
    termios mode{};
    ASSERT_EQ(::tcgetattr(end.get(), &mode), 0);
    EXPECT_NE(mode.c_cflag & HUPCL, 0U) << "DTR falls when it is closed";
}

TEST_F(BoardBoot, LeavesALineAloneThatAnotherProgramHolds) {
    {
        const auto holder = LinkLine::open({.place = line.string()});
        ASSERT_TRUE(holder);
        EXPECT_THAT(refusal(ask_for_boot_mode(line)), HasSubstr("lockstep down"));
        const auto second = LinkLine::open({.place = line.string()});
        ASSERT_FALSE(second);
        EXPECT_THAT(second.error(), HasSubstr("another program uses it"));
    }
    EXPECT_TRUE(ask_for_boot_mode(line));
    EXPECT_THAT(refusal(ask_for_boot_mode("/dev/none")), HasSubstr("check the board's cable"));
}

TEST_F(BoardBoot, WaitsForTheDriveOrSaysWhatIsMissing) {
    int looks = 0;
    const auto third_time = [&] { return ++looks < 3 ? Drives{} : Drives{"/media/RPI-RP2"}; };
    EXPECT_EQ(await_drive(line, third_time, 1000ms, directory.path()), std::filesystem::path("/media/RPI-RP2"));
    EXPECT_EQ(looks, 3);
    const auto never = [] { return Drives{}; };
    EXPECT_THAT(refusal(await_drive(line, never, 100ms, directory.path())), HasSubstr("while a motor is enabled"));
    const auto drive = put("disk/by-label/RPI-RP2");
    EXPECT_THAT(refusal(await_drive(line, never, 100ms, directory.path())), HasSubstr("mount " + drive.string()));
}

}  // namespace
}  // namespace lockstep
