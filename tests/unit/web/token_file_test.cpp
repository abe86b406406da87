// The tokens of a server outlive it, in a file that only its user can read.
#include "clients/web/token_file.hpp"

#include <gmock/gmock.h>
#include <gtest/gtest.h>
#include <sys/stat.h>

#include <fstream>

#include "tests/temporary_directory.hpp"

namespace lockstep::web {
namespace {

using testing::HasSubstr;

class TokenFile : public testing::Test {
protected:
    std::string error() const {
        const auto tokens = tokens_of_file(file);
        return tokens ? "" : tokens.error();
    }
    void write(const std::string& text, std::filesystem::perms perms = std::filesystem::perms{0600}) const {
        std::ofstream(file) << text;
        std::filesystem::permissions(file, perms);
    }

    TemporaryDirectory directory;
    std::filesystem::path file = directory.path() / "web" / "tokens";
};

TEST_F(TokenFile, IsMadeOnceAndForItsUserAlone) {
    const auto tokens = tokens_of_file(file);
    ASSERT_TRUE(tokens);
    EXPECT_EQ(tokens->operate.size(), 32u);
    EXPECT_NE(tokens->operate, tokens->view);
    struct stat status {};
    ASSERT_EQ(stat(file.c_str(), &status), 0);
    EXPECT_EQ(status.st_mode & 0777U, 0600U);
    const auto again = tokens_of_file(file);
    ASSERT_TRUE(again);
    EXPECT_EQ(again->operate, tokens->operate);
    EXPECT_EQ(again->view, tokens->view);
}

TEST_F(TokenFile, ThatOthersCanReadIsRefused) {
    ASSERT_TRUE(tokens_of_file(file));
    std::filesystem::permissions(file, std::filesystem::perms{0640});
    EXPECT_THAT(error(), HasSubstr("other users can read it"));
    std::filesystem::remove(file);
    std::filesystem::create_symlink(directory.path() / "elsewhere", file);
    EXPECT_THAT(error(), HasSubstr("other users can read it")) << "a link may lead anywhere";
}

TEST_F(TokenFile, ThatIsNotInItsFormIsRefusedWithTheForm) {
    ASSERT_TRUE(tokens_of_file(file));
    for (const char* text : {"", "operate 0123456789abcdef\n", "operate short\nview 0123456789abcdef\n",
                             "operate 0123456789abcdef\nview 0123456789abcdef\n"}) {
        write(text);
        EXPECT_THAT(error(), HasSubstr("'operate TOKEN' and 'view TOKEN'")) << text;
    }
    write("view 0123456789abcdeg\noperate 0123456789abcdef\n");
    EXPECT_EQ(tokens_of_file(file)->view, "0123456789abcdeg");
}

}  // namespace
}  // namespace lockstep::web
