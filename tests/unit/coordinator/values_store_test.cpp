// The coordinator's file of values: what was kept is there for the next process, and only what is whole is read.
#include "services/coordinator/values_store.hpp"

#include <gtest/gtest.h>
#include <unistd.h>

#include <fstream>
#include <thread>

namespace lockstep {
namespace {

using namespace std::chrono_literals;
namespace fs = std::filesystem;

class KeptInAFile : public testing::Test {
protected:
    KeptInAFile() {
        std::string name = (fs::temp_directory_path() / "values.XXXXXX").string();
        folder_ = mkdtemp(name.data());
    }
    ~KeptInAFile() override { fs::remove_all(folder_); }

    static void not_written(const std::string& why) { ADD_FAILURE() << why; }
    static ProgramDocument edit(std::uint64_t revision, double x) {
        gcode::KeptValues values;
        values.systems[0].origin[0] = x;
        return {{}, gcode::ProgramValues{.revision = revision, .after = values, .at_once = true}};
    }

    fs::path folder_;
    fs::path file_ = "machine/values.textproto";
};

TEST_F(KeptInAFile, AChangeIsThereForTheNextProcess) {
    const fs::path file = folder_ / file_;
    EXPECT_EQ(read_values(file), RevisedValues{});
    {
        ValuesStore store(file, {}, not_written);
        ASSERT_TRUE(store.accept(1, edit(0, 12.5), {}));
        (void)store.step(0s, {});
    }
    const auto read = read_values(file);
    ASSERT_TRUE(read);
    EXPECT_EQ(read->revision, 1U);
    EXPECT_EQ(read->values.systems[0].origin[0], 12.5);
}

TEST_F(KeptInAFile, ThePublishedStateTellsWhatIsOnTheDisk) {
    ValuesStore store(folder_ / file_, {}, not_written);
    ASSERT_TRUE(store.accept(1, edit(0, 12.5), {}));
    std::optional<MachineValues> published = store.step(0s, {5, 6});
    ASSERT_TRUE(published);
    EXPECT_EQ(published->revision, 1U);
    EXPECT_EQ(published->term, (Term{5, 6}));
    for (auto now = 1s; published->kept != 1; now += 1s) {
        std::this_thread::sleep_for(1ms);
        if (const auto next = store.step(now, {5, 6})) { published = next; }
    }
    EXPECT_EQ(values_from_bytes(published->bytes)->values.systems[0].origin[0], 12.5);
}

TEST_F(KeptInAFile, AnUnfinishedFileOfAProcessThatDiedChangesNothing) {
    const fs::path file = folder_ / file_;
    {
        ValuesStore store(file, {}, not_written);
        ASSERT_TRUE(store.accept(1, edit(0, 12.5), {}));
        (void)store.step(0s, {});
    }
    std::ofstream(file.string() + ".new") << "revision: 2 sys";
    EXPECT_EQ(read_values(file)->revision, 1U);
}

TEST_F(KeptInAFile, ADamagedFileIsRefusedWithItsPlace) {
    const fs::path file = folder_ / "damaged";
    std::ofstream(file) << "revision: 2\nsystem { name: \"G5";
    const auto read = read_values(file);
    ASSERT_FALSE(read);
    EXPECT_EQ(read.error().front().line, 2);
}

TEST_F(KeptInAFile, AWriteThatFailedIsRepeated) {
    static int complaints = 0;
    const fs::path folder = folder_ / "machine";
    std::ofstream(folder) << "a file where the folder is to be";
    ValuesStore store(folder / "values.textproto", {}, [](const std::string&) { ++complaints; });
    ASSERT_TRUE(store.accept(1, edit(0, 12.5), {}));
    (void)store.step(0s, {});
    while (complaints == 0) { std::this_thread::sleep_for(1ms); }
    fs::remove(folder);
    fs::create_directories(folder);
    std::optional<MachineValues> published;
    for (auto now = 10s; !published || published->kept != 1; now += 10s) {
        std::this_thread::sleep_for(1ms);
        published = store.step(now, {});
    }
    EXPECT_EQ(read_values(folder / "values.textproto")->revision, 1U);
}

}  // namespace
}  // namespace lockstep
