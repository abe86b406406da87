// `lockstep board list` finds the serial lines at which a board may be.
#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <fstream>

#include "clients/lockstep/live/boards_report.hpp"
#include "tests/temporary_directory.hpp"

namespace lockstep {
namespace {

using testing::ElementsAre;
using testing::IsEmpty;

class FreeAdapters : public testing::Test {
protected:
    std::string line(const std::string& name) const {
        std::ofstream(directory.path() / name) << "";
        return "serial:" + (directory.path() / name).string();
    }
    std::string by_name(const std::string& name, const std::string& line) const {
        std::filesystem::create_directories(directory.path() / "serial/by-id");
        const auto link = directory.path() / "serial/by-id" / name;
        std::filesystem::create_symlink("../../" + line, link);
        return "serial:" + link.string();
    }
    std::vector<std::string> found(const std::string& link = "") const {
        MachineSetup machine;
        if (!link.empty()) { machine.board_links.push_back({.name = "pico1", .link = read_link_name(link).value()}); }
        return free_adapters(machine, directory.path());
    }

    TemporaryDirectory directory;
};

TEST_F(FreeAdapters, NamesABoardAtUsbByItsLastingName) {
    line("ttyACM0");
    const std::string name = by_name("usb-Lockstep_Motor_board_E66138528349-if00", "ttyACM0");
    EXPECT_THAT(found(), ElementsAre(name));
}

TEST_F(FreeAdapters, NamesALineThatHasNoLastingName) {
    line("ttyS0");
    const std::string board = line("ttyACM0");
    const std::string adapter = line("ttyUSB1");
    EXPECT_THAT(found(), ElementsAre(board, adapter));
}

TEST_F(FreeAdapters, LeavesOutALineOfTheMachineByAnyOfItsNames) {
    const std::string board = line("ttyACM0");
    const std::string name = by_name("usb-Lockstep_Motor_board_E66138528349-if00", "ttyACM0");
    EXPECT_THAT(found(board), IsEmpty());
    EXPECT_THAT(found(name), IsEmpty());
}

}  // namespace
}  // namespace lockstep
