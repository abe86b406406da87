// Programs as the posts of common CAM programs write them, and by hand.
#include <gtest/gtest.h>

#include <filesystem>
#include <fstream>
#include <iterator>
#include <string>

#include "tests/integration/oracle/compare.hpp"

namespace lockstep::oracle {
namespace {

namespace fs = std::filesystem;

TEST(OraclePosts, DoTheSame) {
    if (!is_rs274_installed()) { GTEST_SKIP() << "rs274 is not installed; apt-get install linuxcnc-uspace"; }
    int programs = 0;
    for (const auto& entry : fs::directory_iterator("tests/integration/oracle/posts")) {
        std::ifstream in(entry.path(), std::ios::binary);
        const std::string text{std::istreambuf_iterator<char>(in), {}};
        const Reading theirs = read_with_rs274(text);
        const Reading ours = read_with_ours(text);
        EXPECT_TRUE(theirs.taken) << entry.path() << ": " << theirs.message << "\n" << theirs.refused;
        EXPECT_TRUE(ours.taken) << entry.path() << ":" << ours.line << ": " << ours.message;
        EXPECT_EQ(compare(text, theirs, ours), "") << entry.path();
        EXPECT_GT(ours.calls.size(), 10U) << entry.path();
        ++programs;
    }
    EXPECT_GE(programs, 11);
}

}  // namespace
}  // namespace lockstep::oracle
