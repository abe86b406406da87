// A process also records to its own board's disk, in LCM's format and with bounded size.
#include "services/record/own_log.hpp"

#include <gtest/gtest.h>
#include <sched.h>
#include <sys/mount.h>

#include <algorithm>
#include <fstream>

#include "services/record/rotating_log.hpp"
#include "services/wire/lcm/lcm_log.hpp"

namespace lockstep {
namespace {

namespace fs = std::filesystem;

class OwnLog : public testing::Test {
protected:
    OwnLog() { fs::remove_all(folder); }
    ~OwnLog() override { fs::remove_all(folder); }

    RotatingLog begin(std::uint64_t limit) {
        return RotatingLog::open({.directory = folder, .name = "axis-X", .limit_bytes = limit}).value();
    }
    static void write(RecordSink& log, std::int64_t from, std::int64_t to) {
        for (std::int64_t i = from; i < to; ++i) { log.write("STEPS", i, std::vector<std::uint8_t>(967)); }  // 1000 B
    }
    std::vector<fs::path> files() const {
        std::vector<fs::path> found;
        for (const auto& entry : fs::directory_iterator(folder)) { found.push_back(entry.path()); }
        std::ranges::sort(found);
        return found;
    }
    /// The times of all events there, file after file.
    std::vector<std::int64_t> times() const {
        std::vector<std::int64_t> out;
        for (const fs::path& file : files()) {
            auto reader = LogReader::open(file).value();
            while (const auto event = reader.next().value()) { out.push_back(event->utime); }
        }
        return out;
    }

    fs::path folder = fs::path(testing::TempDir()) / "lockstep_own_log" /
                      testing::UnitTest::GetInstance()->current_test_info()->name();
};

TEST_F(OwnLog, KeepsTheNewestAndNeverOutgrowsItsLimit) {
    constexpr std::uint64_t kLimit = 80'000;
    auto log = begin(kLimit);
    for (std::int64_t i = 0; i < 1000; i += 5) {
        write(log, i, i + 5);
        log.flush();
        std::uint64_t bytes = 0;
        for (const fs::path& file : files()) { bytes += fs::file_size(file); }
        ASSERT_LE(bytes, kLimit);
    }
    const auto kept = times();
    EXPECT_EQ(kept.back(), 999);
    EXPECT_EQ(kept.back() - kept.front() + 1, static_cast<std::int64_t>(kept.size())) << "none between is missing";
    EXPECT_GE(kept.size(), 70U);
    EXPECT_EQ(log.failures(), 0U);
}

TEST_F(OwnLog, ANewProcessAppendsToTheOneBefore) {
    {
        auto log = begin(1'000'000);
        write(log, 0, 10);
    }
    {
        auto log = begin(1'000'000);
        write(log, 10, 20);
    }
    EXPECT_EQ(files().size(), 2U);
    EXPECT_EQ(times().size(), 20U);
}

TEST_F(OwnLog, KeepsTheLogsOfTwoParallelProcesses) {
    {
        auto one = begin(1'000'000);
        auto other = begin(1'000'000);
        write(one, 0, 10);
        write(other, 10, 20);
    }
    EXPECT_EQ(times().size(), 20U);
}

TEST_F(OwnLog, FilesOfOthersAreLeftAlone) {
    fs::create_directories(folder);
    for (const char* name : {"axis-XY.000001.lcm", "axis-X.notes.lcm", "axis-X..lcm"}) {
        std::ofstream(folder / name) << std::string(100'000, 'a');
    }
    auto log = begin(80'000);
    write(log, 0, 500);
    EXPECT_TRUE(fs::exists(folder / "axis-XY.000001.lcm"));
    EXPECT_TRUE(fs::exists(folder / "axis-X.notes.lcm"));
    EXPECT_TRUE(fs::exists(folder / "axis-X..lcm"));
}

TEST_F(OwnLog, ReportsAnImpossibleDirectoryWithTheRemedy) {
    fs::create_directories(folder.parent_path());
    std::ofstream(folder.string()) << "a file is in the way";
    MachineSetup machine{{.name = "mill"}};
    machine.axes.push_back({.name = "X"});
    machine.record.directory = folder / "below";
    const auto log = open_own_log(machine, "X");
    ASSERT_FALSE(log);
    EXPECT_NE(log.error().find(folder.string()), std::string::npos) << log.error();
    EXPECT_NE(log.error().find("record { directory }"), std::string::npos) << log.error();
}

TEST_F(OwnLog, ADirectoryThatGoesIsMadeUpForByTheNextFile) {
    auto log = begin(80'000);
    write(log, 0, 5);
    log.flush();
    fs::remove_all(folder);
    write(log, 5, 20);  // the file fills up, and no next one can be made
    EXPECT_GT(log.failures(), 0U);
    fs::create_directories(folder);
    const std::uint64_t failed = log.failures();
    write(log, RotatingLog::kRetry_us + 20, RotatingLog::kRetry_us + 25);
    log.flush();
    EXPECT_EQ(log.failures(), failed);
    EXPECT_EQ(times().back(), RotatingLog::kRetry_us + 24);
}

/// Mounts a disk of `size` bytes on a directory, visible only to this process.
bool mount_disk(const fs::path& folder, const char* size, unsigned long flags = 0) {
    return mount("tmpfs", folder.c_str(), "tmpfs", flags, size) == 0;
}

TEST_F(OwnLog, AFullDiskLeavesRoomForLossMessagesAndIsUsedAgainLater) {
    fs::create_directories(folder);
    if (unshare(CLONE_NEWNS) != 0 || mount("none", "/", nullptr, MS_REC | MS_PRIVATE, nullptr) != 0 ||
        !mount_disk(folder, "size=400k")) {
        GTEST_SKIP() << "may not mount its own disk";
    }
    {
        auto log = begin(80'000'000);
        write(log, 0, 1000);
        const std::uint64_t failed = log.failures();
        EXPECT_GT(failed, 500U);
        log.write_kept("LOSS", 1000, std::vector<std::uint8_t>(100));
        log.flush();
        EXPECT_EQ(log.failures(), failed) << "the loss is written, other messages are not";
        EXPECT_EQ(times().back(), 1000);
        ASSERT_TRUE(mount_disk(folder, "size=4m", MS_REMOUNT));
        write(log, 2000, 2010);
        log.flush();
        EXPECT_EQ(log.failures(), failed);
        EXPECT_EQ(times().back(), 2009);
        EXPECT_EQ(files().size(), 1U);
    }
    EXPECT_EQ(umount(folder.c_str()), 0);
}

}  // namespace
}  // namespace lockstep
