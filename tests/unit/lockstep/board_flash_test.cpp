// The firmware of a board comes to the right drive, whole, or not at all.
#include "clients/lockstep/live/board_flash.hpp"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <cstdint>
#include <fstream>
#include <iterator>

#include "tests/temporary_directory.hpp"

namespace lockstep {
namespace {

using testing::ElementsAre;
using testing::HasSubstr;
using testing::IsEmpty;

std::string block(std::uint32_t family = 0xE48BFF56) {
    const std::uint32_t head[] = {0x0A324655, 0x9E5D5157, 0x2000, 0x10000000, 256, 0, 1, family};
    std::string bytes(reinterpret_cast<const char*>(head), sizeof head);
    bytes.resize(512);
    return bytes;
}

class BoardFlash : public testing::Test {
protected:
    std::filesystem::path file(const std::string& name, const std::string& bytes) const {
        std::ofstream(directory.path() / name, std::ios::binary) << bytes;
        return directory.path() / name;
    }
    std::filesystem::path drive(const std::string& name, const std::string& board) const {
        std::filesystem::create_directory(directory.path() / name);
        file(name + "/INFO_UF2.TXT", "UF2 Bootloader v2.0\nModel: Raspberry Pi RP2\nBoard-ID: " + board + "\n");
        return directory.path() / name;
    }
    static std::string content(const std::filesystem::path& path) {
        std::ifstream stream(path, std::ios::binary);
        return {std::istreambuf_iterator<char>(stream), {}};
    }
    static std::string refusal(const auto& result) { return result ? "" : result.error().errors.front().message; }

    TemporaryDirectory directory;
};

TEST_F(BoardFlash, TakesOnlyFilesForThisChip) {
    EXPECT_EQ(read_firmware(file("good.uf2", block() + block())), block() + block());
    EXPECT_THAT(refusal(read_firmware(file("other.uf2", block() + block(0x68ED2B88)))), HasSubstr("block 1 is none"));
    EXPECT_THAT(refusal(read_firmware(file("short.uf2", block() + "x"))), HasSubstr("no UF2 file"));
    EXPECT_THAT(refusal(read_firmware(file("empty.uf2", ""))), HasSubstr("no UF2 file"));
    EXPECT_THAT(refusal(read_firmware(directory.path() / "none.uf2")), HasSubstr("No such file"));
}

TEST_F(BoardFlash, FindsTheDrivesOfPicosAmongAllMounts) {
    const auto pico = drive("RPI RP2", "RPI-RP2");
    const auto other = drive("other", "SAMD21");
    std::string escaped = pico.string();
    escaped.replace(escaped.find(' '), 1, "\\040");
    const std::string mounts =
        "proc /proc proc rw 0 0\n/dev/sdb1 " + other.string() + " vfat rw 0 0\n/dev/sda1 " + escaped + " vfat rw 0 0\n";
    EXPECT_THAT(pico_drives(mounts), ElementsAre(pico));
    EXPECT_THAT(pico_drives(""), IsEmpty());
    EXPECT_THAT(refusal(only_drive({})), HasSubstr("BOOTSEL"));
    EXPECT_THAT(refusal(only_drive({pico, other})), HasSubstr("--drive"));
}

TEST_F(BoardFlash, WritesAllOfItOrSaysWhyNot) {
    const auto pico = drive("RPI-RP2", "RPI-RP2");
    ASSERT_TRUE(write_firmware(block(), pico));
    EXPECT_EQ(content(pico / "lockstep-board.uf2"), block());
    EXPECT_THAT(refusal(write_firmware(block(), drive("other", "SAMD21"))), HasSubstr("no INFO_UF2.TXT of a Pico"));
    std::filesystem::create_directory(drive("taken", "RPI-RP2") / "lockstep-board.uf2");
    EXPECT_THAT(refusal(write_firmware(block(), directory.path() / "taken")), HasSubstr("directory"));
}

}  // namespace
}  // namespace lockstep
