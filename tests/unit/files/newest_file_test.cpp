#include "services/files/newest_file.hpp"

#include <gtest/gtest.h>

#include <thread>

#include "services/files/newest_value.hpp"
#include "services/files/text_file.hpp"
#include "tests/temporary_directory.hpp"

namespace lockstep {
namespace {

TEST(NewestValue, IsTakenOnce) {
    NewestValue<int> value;
    EXPECT_EQ(value.take(), nullptr);
    value.put(1);
    value.put(2);
    const int* taken = value.take();
    ASSERT_NE(taken, nullptr);
    EXPECT_EQ(*taken, 2);
    EXPECT_EQ(value.take(), nullptr);
}

TEST(NewestValue, IsWholeAndNeverOlderBetweenThreads) {
    struct Pair {
        int value = 0;
        int negated = 0;
    };
    constexpr int kLast = 200'000;
    NewestValue<Pair> newest;
    const std::jthread writer([&] {
        for (int i = 1; i <= kLast; ++i) { newest.put({i, -i}); }
    });
    for (int before = 0; before < kLast;) {
        const Pair* pair = newest.take();
        if (pair == nullptr) { continue; }
        ASSERT_EQ(pair->negated, -pair->value);
        ASSERT_GT(pair->value, before);
        before = pair->value;
    }
}

TEST(NewestFile, HasTheNewestValueAtTheEnd) {
    const TemporaryDirectory directory;
    const auto path = directory.path() / "below" / "number";
    {
        NewestFile<int> file(
            path, [](const int& value) { return std::to_string(value); },
            [](const std::string& why) { FAIL() << why; });
        for (int i = 1; i <= 1'000; ++i) { file.keep(static_cast<std::uint64_t>(i), i); }
    }
    EXPECT_EQ(read_text_file(path).value(), "1000");
}

}  // namespace
}  // namespace lockstep
