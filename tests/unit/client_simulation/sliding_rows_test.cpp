// Rows in memory are read as they were written, and forgotten when they are released.
#include "clients/simulation/sliding_rows.hpp"

#include <gtest/gtest.h>

#include <array>

namespace lockstep {
namespace {

constexpr std::size_t kWidth = 2;

std::array<double, kWidth> row_of(std::uint32_t number) { return {static_cast<double>(number), -0.5 * number}; }

void append(SlidingRows& rows, std::uint32_t from, std::uint32_t to) {
    for (; from < to; ++from) { ASSERT_TRUE(rows.append(row_of(from))); }
}

bool has(SlidingRows& rows, std::uint32_t number) {
    std::array<double, kWidth> row{};
    return rows.read(number, row) && row == row_of(number);
}

TEST(SlidingRows, AreForgottenBeforeTheOneThatIsBeforeTheReleased) {
    SlidingRows rows(kWidth, 100);
    append(rows, 0, 80);
    rows.release_before(31);
    EXPECT_EQ(rows.first_row(), 30U);
    EXPECT_FALSE(has(rows, 29));
    for (std::uint32_t number = 30; number < 80; ++number) { EXPECT_TRUE(has(rows, number)) << number; }
    EXPECT_FALSE(has(rows, 80)) << "not written yet";
    rows.release_before(20);
    EXPECT_EQ(rows.first_row(), 30U) << "as before";
}

TEST(SlidingRows, MakeRoomForOthers) {
    SlidingRows rows(kWidth, 100);
    append(rows, 0, 100);
    EXPECT_EQ(rows.free_rows(), 0U);
    rows.release_before(41);
    EXPECT_EQ(rows.free_rows(), 40U);
    append(rows, 100, 140);
    EXPECT_TRUE(has(rows, 139));
    rows.widen(5);
    EXPECT_EQ(rows.free_rows(), 5U);
    EXPECT_EQ(rows.most_kept(), 100U);
}

}  // namespace
}  // namespace lockstep
