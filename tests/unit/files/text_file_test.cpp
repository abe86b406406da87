// Files that cannot be read report why.
#include "services/files/text_file.hpp"

#include <gmock/gmock.h>
#include <gtest/gtest.h>
#include <signal.h>
#include <sys/wait.h>
#include <unistd.h>

#include <chrono>
#include <fstream>
#include <thread>

#include "services/documents/machine_file.hpp"

namespace lockstep {
namespace {

using testing::HasSubstr;

class TextFile : public testing::Test {
protected:
    void SetUp() override { std::filesystem::create_directories(folder_); }
    void TearDown() override { std::filesystem::remove_all(folder_); }

    std::filesystem::path write(std::string_view content) const {
        std::ofstream(folder_ / "file", std::ios::binary) << content;
        return folder_ / "file";
    }
    static std::string refused_to_nobody(const std::filesystem::path& path) {
        if (setegid(65534) != 0 || seteuid(65534) != 0) { return "cannot act as nobody"; }
        const std::string text = refusal(path);
        return seteuid(0) == 0 && setegid(0) == 0 ? text : "cannot act as root again";
    }

    static std::string refusal(const std::filesystem::path& path) {
        const auto text = read_text_file(path);
        return text ? "none" : text.error().message;
    }

    std::filesystem::path folder_ =
        std::filesystem::path(testing::TempDir()) / testing::UnitTest::GetInstance()->current_test_info()->name();
};

TEST_F(TextFile, NamesTheDirectoryThatTheUserMayNotEnterAndTheGroupThatMay) {
    if (geteuid() != 0) { GTEST_SKIP() << "only root can act as another user"; }
    const std::filesystem::path file = folder_ / "inner" / "file";
    std::filesystem::create_directories(file.parent_path());
    write("text");
    ASSERT_EQ(chown(folder_.c_str(), 0, 8), 0);  // the group mail, in every Debian
    std::filesystem::permissions(folder_, std::filesystem::perms{0750});
    EXPECT_EQ(refused_to_nobody(file), "cannot be read: this user may not enter the directory " + folder_.string() +
                                           "; its group mail may: as root, adduser nobody mail, then log in again");
    std::filesystem::permissions(folder_, std::filesystem::perms::owner_all);
    EXPECT_THAT(refused_to_nobody(file), HasSubstr(folder_.string() + "; only its owner root may"));
}

TEST_F(TextFile, NamesTheGroupThatMayReadIt) {
    if (geteuid() != 0) { GTEST_SKIP() << "only root can act as another user"; }
    const std::filesystem::path file = write("text");
    ASSERT_EQ(chown(file.c_str(), 0, 8), 0);
    std::filesystem::permissions(file, std::filesystem::perms{0640});
    EXPECT_EQ(refused_to_nobody(file),
              "cannot be read: this user may not read it; its group mail may: as root, adduser nobody mail, then log "
              "in again");
}

TEST_F(TextFile, IsReadWhole) { EXPECT_EQ(read_text_file(write("one\r\ntwo")).value(), "one\r\ntwo"); }

TEST_F(TextFile, ThatIsMissingEmptyBinaryOrNoFileIsRefused) {
    EXPECT_THAT(refusal(folder_ / "nothing"), HasSubstr("no such file"));
    EXPECT_THAT(refusal(folder_), HasSubstr("directory"));
    EXPECT_THAT(refusal("/dev/null"), HasSubstr("not a regular file"));
    EXPECT_THAT(refusal(write("")), HasSubstr("empty"));
    EXPECT_THAT(refusal(write(std::string_view("a\0b", 3))), HasSubstr("not text"));
}

TEST_F(TextFile, WithAZeroByteIsRefusedWithItsPlace) {
    const auto text = read_text_file(write(std::string_view("one\ntwo\0three", 13)));
    ASSERT_FALSE(text);
    EXPECT_EQ(text.error().line, 2);
    EXPECT_EQ(text.error().column, 4);
    EXPECT_THAT(text.error().message, HasSubstr("0x00"));
}

TEST_F(TextFile, ItsRefusalIsOfTheFileAsAWhole) {
    const auto machine = load_machine_file(folder_);
    ASSERT_FALSE(machine.has_value());
    EXPECT_EQ(to_text("m.textproto", machine.error()), "m.textproto: error: this is a directory; name a file in it\n");
}

/// A child process replaces the file again and again until it is killed. This is repeated with many delays.
TEST_F(TextFile, OfAProcessThatIsKilledWhileItReplacesItIsTheOldOrTheNewOne) {
    const auto path = folder_ / "file";
    const std::string texts[] = {std::string(100'000, 'a'), std::string(70'000, 'b')};
    ASSERT_TRUE(replace_text_file(path, texts[0]));
    for (int kills = 0; kills < 50; ++kills) {
        const pid_t writer = fork();
        if (writer == 0) {
            for (std::size_t i = 0;; ++i) { (void)replace_text_file(path, texts[i % 2]); }
        }
        std::this_thread::sleep_for(std::chrono::microseconds(500 + 137 * kills));
        kill(writer, SIGKILL);
        ASSERT_EQ(waitpid(writer, nullptr, 0), writer);
        const auto text = read_text_file(path);
        ASSERT_TRUE(text);
        EXPECT_TRUE(*text == texts[0] || *text == texts[1]) << text->size() << " bytes after kill " << kills;
    }
}

TEST_F(TextFile, ThatCannotBeReplacedStaysAsItWas) {
    const auto path = write("before");
    std::filesystem::create_directories(folder_ / ("file.new-" + std::to_string(getpid())));
    const auto replaced = replace_text_file(path, "after");
    ASSERT_FALSE(replaced);
    EXPECT_THAT(replaced.error(), HasSubstr("cannot be written: "));
    EXPECT_EQ(read_text_file(path).value(), "before");
}

TEST(Diagnostic, ReadsAsACompilersDoes) {
    EXPECT_EQ(to_text("a.gcode", Diagnostic{3, 7, "wrong"}), "a.gcode:3:7: error: wrong");
}

}  // namespace
}  // namespace lockstep
