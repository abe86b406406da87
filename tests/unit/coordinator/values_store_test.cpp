// The coordinator's file of values: the next process reads the values that were kept, and refuses a damaged file.
#include "services/coordinator/values_store.hpp"

#include <gtest/gtest.h>

#include <atomic>
#include <fstream>
#include <thread>

#include "tests/temporary_directory.hpp"

namespace lockstep {
namespace {

using namespace std::chrono_literals;
namespace fs = std::filesystem;

class KeptInAFile : public testing::Test {
protected:
    static void not_written(const std::string& why) { ADD_FAILURE() << why; }
    static ProgramDocument edit(std::uint64_t revision, double x) {
        gcode::KeptValues values;
        values.systems[0].origin[0] = x;
        return {{}, gcode::ProgramValues{.revision = revision, .after = values, .at_once = true}};
    }

    TemporaryDirectory directory_;
    fs::path folder_ = directory_.path();
    fs::path file_ = "machine/values.textproto";
};

TEST_F(KeptInAFile, AChangeIsThereForTheNextProcess) {
    const fs::path file = folder_ / file_;
    EXPECT_EQ(read_values(file), RevisedValues{});
    {
        ValuesStore store(file, {}, not_written);
        ASSERT_TRUE(store.accept({.program = 1}, edit(0, 12.5), {}));
        (void)store.step(0s, {});
    }
    const auto read = read_values(file);
    ASSERT_TRUE(read);
    EXPECT_EQ(read->revision, 1U);
    EXPECT_EQ(read->values.systems[0].origin[0], 12.5);
}

TEST_F(KeptInAFile, ThePublishedStateTellsWhatIsOnTheDisk) {
    ValuesStore store(folder_ / file_, {}, not_written);
    ASSERT_TRUE(store.accept({.program = 1}, edit(0, 12.5), {}));
    const MachineValues* published = store.step(0s, {5, 6});
    ASSERT_TRUE(published);
    EXPECT_EQ(published->revision, 1U);
    EXPECT_EQ(published->term, (Term{5, 6}));
    for (auto now = 1s; !published->on_disk; now += 1s) {
        std::this_thread::sleep_for(1ms);
        if (const auto next = store.step(now, {5, 6})) { published = next; }
    }
    EXPECT_EQ(values_from_bytes(published->bytes)->values.systems[0].origin[0], 12.5);
}

TEST_F(KeptInAFile, AChangeIsPublishedAtOnce) {
    ValuesStore store(folder_ / file_, {}, not_written);
    ASSERT_TRUE(store.step(0s, {}));
    EXPECT_EQ(store.step(1ms, {}), nullptr);
    ASSERT_TRUE(store.accept({.program = 1}, edit(0, 12.5), {}));
    const auto published = store.step(2ms, {});
    ASSERT_TRUE(published);
    EXPECT_EQ(published->revision, 1U);
}

/// Each of two hosts has a file of its own; both have counted to the same revision.
TEST_F(KeptInAFile, ATakeoverReplacesTheFileByTheFormerOwnersValues) {
    const fs::path file = folder_ / file_;
    RevisedValues owners{.revision = 4, .values = {}};
    owners.values.systems[2].rotation = 30;
    {
        ValuesStore store(file, {.revision = 4, .values = {}}, not_written);
        store.follow({.revision = 4, .on_disk = true, .bytes = values_bytes(owners)});
        const auto published = store.step(0s, {});
        ASSERT_TRUE(published);
        EXPECT_EQ(values_from_bytes(published->bytes), owners);
    }
    EXPECT_EQ(read_values(file), owners);
}

TEST_F(KeptInAFile, AFileThatCannotBeReadIsNotTakenForAMissingOne) {
    const fs::path loop = folder_ / "loop";
    fs::create_symlink(loop, loop);
    EXPECT_FALSE(read_values(loop));
    EXPECT_FALSE(read_values(folder_)) << "a folder";
}

TEST_F(KeptInAFile, AnUnfinishedFileOfAProcessThatDiedChangesNothing) {
    const fs::path file = folder_ / file_;
    {
        ValuesStore store(file, {}, not_written);
        ASSERT_TRUE(store.accept({.program = 1}, edit(0, 12.5), {}));
        (void)store.step(0s, {});
    }
    std::ofstream(file.string() + ".new-123") << "revision: 2 sys";
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
    static std::atomic<int> failures = 0;
    const fs::path folder = folder_ / "machine";
    std::ofstream(folder) << "a file where the folder is to be";
    ValuesStore store(folder / "values.textproto", {}, [](const std::string&) { ++failures; });
    ASSERT_TRUE(store.accept({.program = 1}, edit(0, 12.5), {}));
    (void)store.step(0s, {});
    while (failures == 0) { std::this_thread::sleep_for(1ms); }
    fs::remove(folder);
    const MachineValues* published = nullptr;
    for (auto now = 10s; published == nullptr || !published->on_disk; now += 10s) {
        std::this_thread::sleep_for(1ms);
        published = store.step(now, {});
    }
    EXPECT_EQ(read_values(folder / "values.textproto")->revision, 1U);
}

}  // namespace
}  // namespace lockstep
