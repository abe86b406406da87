// A failed check names its promise and ends the process, in every build.
#include "core/check.hpp"

#include <gtest/gtest.h>
#include <signal.h>

#include "core/static_vector.hpp"

namespace lockstep {
namespace {

TEST(Check, ReportsNothingIfThePromiseHolds) {
    static int reports = 0;
    const CheckReporter before = set_check_reporter([](std::string_view, const std::source_location&) { ++reports; });
    check(true, "one is one");
    set_check_reporter(before);
    EXPECT_EQ(reports, 0);
}

TEST(CheckDeath, NamesThePromiseAndItsPlace) {
    EXPECT_DEATH(check(1 > 2, "one exceeds two"), "check_test.cpp:[0-9]+: failed check: one exceeds two");
}

TEST(CheckDeath, EndsTheProcessAfterTheReporterReturns) {
    const auto quiet = [](std::string_view, const std::source_location&) {};
    const CheckReporter before = set_check_reporter(quiet);
    EXPECT_EXIT(check(false, "x"), testing::KilledBySignal(SIGABRT), "^$");
    set_check_reporter(before);
}

TEST(CheckDeath, RefusesAPointerToNothing) {
    const int* nothing = nullptr;
    EXPECT_DEATH(check_found(nothing, "a number is found"), "a number is found");
}

TEST(StaticVectorDeath, LosesNoValueAndReadsNoMissingOne) {
    StaticVector<int, 2> full{1, 2};
    EXPECT_DEATH(full.append(3), "has room");
    EXPECT_DEATH((void)full[2], "below its vector's size");
    EXPECT_DEATH(full.erase_front(3), "holds the values");
    StaticVector<int, 2> empty;
    EXPECT_DEATH((void)empty.front(), "below its vector's size");
    EXPECT_DEATH((void)empty.back(), "below its vector's size");
    EXPECT_DEATH(empty.pop_back(), "last value");
}

TEST(StaticVector, ReportsThatItIsFull) {
    StaticVector<int, 1> values;
    EXPECT_TRUE(values.push_back(1));
    EXPECT_FALSE(values.push_back(2));
    EXPECT_EQ(values.size(), 1U);
}

}  // namespace
}  // namespace lockstep
