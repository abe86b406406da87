// Files that cannot be read report why.
#include "services/files/text_file.hpp"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <fstream>

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
    static std::string refusal(const std::filesystem::path& path) {
        const auto text = read_text_file(path);
        return text ? "none" : text.error().message;
    }

    std::filesystem::path folder_ =
        std::filesystem::path(testing::TempDir()) / testing::UnitTest::GetInstance()->current_test_info()->name();
};

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

TEST(Diagnostic, ReadsAsACompilersDoes) {
    EXPECT_EQ(to_text("a.gcode", Diagnostic{3, 7, "wrong"}), "a.gcode:3:7: error: wrong");
}

}  // namespace
}  // namespace lockstep
