// If one axis has two processes, exactly one ends: the newer one. The readings of their hosts' clocks do not matter.
#include "core/protocol/rival.hpp"

#include <gtest/gtest.h>

#include <array>

namespace lockstep {
namespace {

constexpr std::int64_t kSecond = 1'000'000;

/// Two processes that publish every 10 ms from their starts on, each by its own clock, and receive each other
/// after `discovery`. A state proves the other's life from the 20th on.
struct Pair {
    struct Process {
        std::uint64_t identity = 0;
        std::int64_t started = 0;  // true time
        std::int64_t clock = 0;    // its reading at true time 0
        std::int64_t discovery = 500'000;
    };
    std::array<Process, 2> processes;
    std::int64_t joined = 0;  // before that they are on separate networks

    /// Whether each process ends within a minute.
    std::array<bool, 2> left() const {
        std::array<bool, 2> left{};
        std::array<int, 2> received{};
        std::array<Rival, 2> rivals{rival(0), rival(1)};
        const std::int64_t both = std::max({processes[0].started, processes[1].started, joined});
        for (std::int64_t now = both; now < both + 60 * kSecond; now += 10'000) {
            const auto before = left;
            for (const std::size_t i : {0U, 1U}) {
                if (before[0] || before[1] || now < both + processes[i].discovery) { continue; }
                const bool proved = ++received[i] >= 20;
                left[i] = rivals[i].must_leave(processes[1 - i].identity, proved, Tick{now + processes[i].clock});
            }
        }
        return left;
    }
    Rival rival(std::size_t i) const {
        return Rival(processes[i].identity, 1000, Tick{processes[i].started + processes[i].clock});
    }
};

constexpr std::array kNewcomerLeaves{false, true};

TEST(Rival, TheNewcomerLeavesThoughItsClockIsYounger) {
    const Pair pair{{{{.identity = 9'000, .started = 0, .clock = 100 * kSecond},
                      {.identity = 5, .started = 60 * kSecond, .clock = -59 * kSecond}}}};
    EXPECT_EQ(pair.left(), kNewcomerLeaves);
}

TEST(Rival, TheNewcomerLeavesThoughItsClockIsOlder) {
    const Pair pair{{{{.identity = 5, .started = 0}, {.identity = 9'000, .started = 60 * kSecond, .clock = kSecond}}}};
    EXPECT_EQ(pair.left(), kNewcomerLeaves);
}

TEST(Rival, OfTwoStartedTogetherTheHigherIdentityLeaves) {
    for (const std::int64_t discovery : {0L, 400'000L, 2 * kSecond}) {
        const Pair pair{{{{.identity = 5, .started = 0, .discovery = discovery},
                          {.identity = 6, .started = 100'000, .clock = -kSecond}}}};
        EXPECT_EQ(pair.left(), (std::array{false, true})) << discovery;
    }
}

TEST(Rival, TheHigherIdentityLeavesAfterNetworksAreJoined) {
    const Pair pair{.processes = {{{.identity = 5}, {.identity = 6}}}, .joined = 600 * kSecond};
    EXPECT_EQ(pair.left(), (std::array{false, true}));
}

TEST(Rival, ExactlyOneLeavesWhateverTheirStartsAndDiscoveries) {
    for (std::int64_t apart = 0; apart < 12 * kSecond; apart += 300'000) {
        for (std::int64_t slower = 0; slower <= 2 * kSecond; slower += 500'000) {
            for (const bool swapped : {false, true}) {
                const Pair pair{{{{.identity = swapped ? 6U : 5U, .started = 0, .discovery = slower},
                                  {.identity = swapped ? 5U : 6U, .started = apart, .clock = 7 * apart}}}};
                const auto left = pair.left();
                EXPECT_NE(left[0], left[1]) << apart << " us apart, discovery slower by " << slower << " us";
            }
        }
    }
}

TEST(Rival, NoneLeavesForAProcessWithoutProof) {
    Rival rival(9, 1000, Tick{});
    for (int i = 0; i < 1000; ++i) { EXPECT_FALSE(rival.must_leave(5, false, Tick{i * 10'000})); }
}

}  // namespace
}  // namespace lockstep
