#include "clients/analysis/moves/job_turns.hpp"

#include <gtest/gtest.h>

namespace lockstep::analysis {
namespace {

TEST(JobTurns, GiveAStepToTheJobWhoseTurnItIs) {
    JobTurns turns;
    EXPECT_FALSE(turns.job_at(Tick{5}));
    turns.begin(3, Tick{100});
    turns.begin(4, Tick{200});
    turns.begin(3, Tick{300});  // goes on
    EXPECT_FALSE(turns.job_at(Tick{99}));
    EXPECT_EQ(turns.job_at(Tick{100}), 3U);
    EXPECT_EQ(turns.job_at(Tick{250}), 4U);
    EXPECT_EQ(turns.job_at(Tick{1000}), 3U);
    EXPECT_EQ(turns.next_after(Tick{100}), Tick{200});
    EXPECT_EQ(turns.next_after(Tick{99}), Tick{100});
}

TEST(JobTurns, KeepTheNewest) {
    JobTurns turns;
    for (std::size_t i = 0; i <= JobTurns::kKept; ++i) { turns.begin(i, Tick{static_cast<std::int64_t>(i)}); }
    EXPECT_FALSE(turns.job_at(Tick{0}));
    EXPECT_EQ(turns.job_at(Tick{1}), 1U);
}

}  // namespace
}  // namespace lockstep::analysis
