// LinuxCNC's own example programs, from Debian's package.
#include <gtest/gtest.h>

#include <algorithm>
#include <array>
#include <filesystem>
#include <fstream>
#include <iterator>
#include <string>

#include "tests/integration/oracle/compare.hpp"

namespace lockstep::oracle {
namespace {

namespace fs = std::filesystem;

const fs::path kFolder = "/usr/share/linuxcnc/ncfiles";

struct Exception {
    const char* file;
    const char* reason;
};

/// rs274 accepts them. We refuse them with this reason.
constexpr std::array kRefused{
    Exception{"lathe_g7x_face_boring.ngc", "G72 is for lathes"},
    Exception{"lathe_g7x_quadrants.ngc", "G70 is for lathes"},
    Exception{"smartprobe.ngc", "G38.5 goes nowhere"},  // its touch is at the end of the move before
    Exception{"threading.ngc", "G33 needs a spindle encoder"},
};

/// Both accept them, but act differently.
constexpr std::array kApart{
    Exception{"roparams.ngc", "prints the number of LinuxCNC's version"},
    Exception{"skeleton.ngc", "rs274 alone has no tool changer, and is lost behind M6 and G43 in a block"},
    Exception{"useful-subroutines.ngc", "rs274 alone has no tool changer, and forgets the programmed place at M6"},
    Exception{"x-trim.ngc", "rs274 alone rests before the end of a probing move"},
};

template <std::size_t count>
const Exception* find(const std::array<Exception, count>& exceptions, const std::string& file) {
    const auto found = std::ranges::find_if(exceptions, [&](const Exception& one) { return one.file == file; });
    return found == exceptions.end() ? nullptr : &*found;
}

struct Counts {
    int files = 0;
    int taken_by_them = 0;
    int taken = 0;
    int same = 0;
};

void check(const std::string& file, const std::string& text, const Reading& theirs, const Reading& ours,
           Counts& counts) {
    const Exception* const refused = find(kRefused, file);
    const Exception* const apart = find(kApart, file);
    if (!ours.taken) {
        EXPECT_TRUE(refused != nullptr && ours.message.starts_with(refused->reason)) << file << ": " << ours.message;
        return;
    }
    ++counts.taken;
    EXPECT_EQ(refused, nullptr) << file << " is taken now";
    const std::string difference = compare(text, theirs, ours);
    counts.same += difference.empty() ? 1 : 0;
    EXPECT_EQ(difference.empty(), apart == nullptr) << file << ": " << difference;
}

TEST(OracleExamples, DoTheSame) {
    if (!is_rs274_installed()) { GTEST_SKIP() << "rs274 is not installed; apt-get install linuxcnc-uspace"; }
    Counts counts;
    for (const auto& entry : fs::recursive_directory_iterator(kFolder)) {
        if (entry.path().extension() != ".ngc") { continue; }
        ++counts.files;
        std::ifstream in(entry.path(), std::ios::binary);
        const std::string text{std::istreambuf_iterator<char>(in), {}};
        const std::string folder = entry.path().parent_path().string();
        const Reading theirs = read_with_rs274(text, folder);
        if (!theirs.taken) { continue; }  // most are subroutines, which do not end as programs do
        ++counts.taken_by_them;
        check(fs::relative(entry.path(), kFolder).string(), text, theirs, read_with_ours(text, folder), counts);
    }
    std::printf("%d files: rs274 takes %d; of these we take %d, and %d do the same\n", counts.files,
                counts.taken_by_them, counts.taken, counts.same);
    EXPECT_EQ(counts.taken_by_them - counts.taken, static_cast<int>(kRefused.size()));
    EXPECT_EQ(counts.taken - counts.same, static_cast<int>(kApart.size()));
}

}  // namespace
}  // namespace lockstep::oracle
