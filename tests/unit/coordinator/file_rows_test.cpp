// Rows of numbers on a disk: read as they were written, in bounded memory, and with a disk that is full.
#include "services/coordinator/file_rows.hpp"

#include <gtest/gtest.h>

#include <array>
#include <chrono>
#include <thread>

#include "tests/temporary_directory.hpp"
#include "tests/unit/allocations/counted_allocations.hpp"

namespace lockstep {
namespace {

constexpr std::size_t kWidth = 4;
constexpr std::uint32_t kPageRows = FileRows::kPageBytes / (kWidth * sizeof(double));
constexpr std::uint64_t kPlenty = std::uint64_t{1} << 30;

class Rows : public testing::Test {
protected:
    static std::array<double, kWidth> row_of(std::uint32_t number) {
        return {static_cast<double>(number), number / 3.0, -1.5 * number, 7};
    }
    /// Appends rows as fast as the disk takes them.
    static void append(FileRows& rows, std::uint32_t from, std::uint32_t to) {
        for (; from < to; ++from) {
            while (rows.free_rows() == 0) { std::this_thread::yield(); }
            ASSERT_TRUE(rows.append(row_of(from)));
        }
    }
    /// Reads a row. Waits until it is in memory.
    static std::array<double, kWidth> read(FileRows& rows, std::uint32_t number) {
        std::array<double, kWidth> row{};
        while (!rows.read(number, row)) { std::this_thread::sleep_for(std::chrono::microseconds{100}); }
        return row;
    }

    TemporaryDirectory directory;
};

TEST_F(Rows, AreReadAsTheyWereWritten) {
    constexpr std::uint32_t kRows = 200 * kPageRows + 17;
    FileRows rows(kWidth, directory.path(), kPlenty);
    append(rows, 0, kRows);
    for (std::uint32_t number = 0; number < kRows; number += 97) { ASSERT_EQ(read(rows, number), row_of(number)); }
    EXPECT_EQ(read(rows, kRows - 1), row_of(kRows - 1));
    EXPECT_EQ(read(rows, 5), row_of(5)) << "long after";
    EXPECT_EQ(rows.first_row(), 0u);
    EXPECT_TRUE(std::filesystem::is_empty(directory.path())) << "nothing is left where the coordinator is killed";
}

/// Counts the allocations of the thread that reads.
TEST_F(Rows, AreReadWithoutAllocationOnceTheMemoryIsFull) {
    constexpr std::uint32_t kRows = 200 * kPageRows;
    FileRows rows(kWidth, directory.path(), kPlenty);
    append(rows, 0, kRows);
    for (std::uint32_t number = 0; number < kRows; number += 97) { (void)read(rows, number); }
    {
        const CountedAllocations counted;
        for (std::uint32_t number = 0; number < kRows; number += 97) { (void)read(rows, number); }
    }
    EXPECT_EQ(CountedAllocations::count(), 0u) << CountedAllocations::places();
}

TEST_F(Rows, OfAShortProgramNeedNoDisk) {
    FileRows rows(kWidth, "/proc/no-such-place", kPlenty);
    append(rows, 0, 10 * kPageRows);
    EXPECT_EQ(read(rows, 3), row_of(3));
}

TEST_F(Rows, OfAFullOrMissingDiskAreNotTakenAndThoseTakenAreKept) {
    FileRows rows(kWidth, "/proc/no-such-place", kPlenty);
    std::uint32_t taken = 0;
    std::expected<void, std::string> answer;
    while ((answer = rows.append(row_of(taken)))) {
        ++taken;
        while (rows.free_rows() == 0) { std::this_thread::yield(); }
    }
    EXPECT_NE(answer.error().find("/proc/no-such-place"), std::string::npos) << answer.error();
    EXPECT_GT(taken, 15 * kPageRows);
    for (std::uint32_t number = 0; number < taken; number += 97) { ASSERT_EQ(read(rows, number), row_of(number)); }
}

TEST_F(Rows, MakeRoomForOthersWhenTheyWereReleased) {
    constexpr std::uint64_t kPages = 2 * FileRows::kCleanPages;
    FileRows rows(kWidth, directory.path(), kPages * FileRows::kPageBytes);
    append(rows, 0, kPages * kPageRows);
    while (rows.free_rows() > 0) { std::this_thread::yield(); }
    EXPECT_EQ(rows.free_rows(), 0u);
    rows.release_before(10 * kPageRows + 3);
    while (rows.free_rows() == 0) { std::this_thread::yield(); }
    append(rows, kPages * kPageRows, (kPages + 9) * kPageRows);
    EXPECT_EQ(rows.first_row(), 9 * kPageRows);
    for (const std::uint32_t page : {9U, 10U, 40U, 70U}) {
        EXPECT_EQ(read(rows, page * kPageRows + 1), row_of(page * kPageRows + 1)) << page;
    }
}

}  // namespace
}  // namespace lockstep
