#include "services/record/reading/number_set.hpp"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <random>
#include <set>

namespace lockstep::analysis {
namespace {

using testing::ElementsAre;
using testing::IsEmpty;

TEST(NumberSet, FindsNumbersMissingBelowTheHighest) {
    NumberSet numbers;
    for (const std::int64_t number : {2, 3, 7}) { EXPECT_TRUE(numbers.add(number)); }
    EXPECT_THAT(numbers.gaps(), ElementsAre(Numbers{0, 2}, Numbers{4, 7}));
    for (const std::int64_t number : {1, 0, 5, 4, 6}) { EXPECT_TRUE(numbers.add(number)); }
    EXPECT_THAT(numbers.gaps(), IsEmpty());
    EXPECT_FALSE(numbers.add(3));
    EXPECT_FALSE(numbers.add(0));
    EXPECT_FALSE(numbers.add(7));
}

TEST(NumberSet, AgreesWithASetOfNumbersWhateverTheirOrder) {
    std::mt19937 random(11);
    for (int round = 0; round < 200; ++round) {
        NumberSet numbers;
        std::set<std::int64_t> all;
        for (int i = 0; i < 60; ++i) {
            const std::int64_t number = random() % 40;
            EXPECT_EQ(numbers.add(number), all.insert(number).second);
        }
        std::int64_t missing = 0;
        for (const Numbers& gap : numbers.gaps()) {
            missing += gap.end - gap.from;
            for (std::int64_t number = gap.from; number < gap.end; ++number) { EXPECT_FALSE(all.contains(number)); }
        }
        EXPECT_EQ(missing, *all.rbegin() + 1 - static_cast<std::int64_t>(all.size()));
    }
}

}  // namespace
}  // namespace lockstep::analysis
