// A process that receives nothing opens its DDS participant again. The tests run in virtual time.
#include "core/protocol/reception_watch.hpp"

#include <gtest/gtest.h>

#include <array>

namespace lockstep {
namespace {

constexpr std::int64_t kTick_ns = 1000;
constexpr Ticks kLease{1'000'000};

/// A process that checks whenever a check is due, and the results.
class Process {
public:
    Reception found{.may_reopen = true};
    std::vector<std::pair<double, ReopenReason>> reopened;  // when, in seconds

    /// Calls `before_each` before each check, to change the results.
    template <typename Change>
    void run(double seconds, Change before_each) {
        const Tick end = now_ + Ticks{static_cast<std::int64_t>(seconds * 1e6)};
        for (; now_ < end; now_ = now_ + kLoop) {
            if (!watch_.is_due(now_)) { continue; }
            before_each();
            if (const auto reason = watch_.look(now_, found)) {
                reopened.emplace_back(static_cast<double>(now_.value) * 1e-6, *reason);
            }
        }
    }
    void run(double seconds) {
        run(seconds, [] {});
    }
    void stall(double seconds) { now_ = now_ + Ticks{static_cast<std::int64_t>(seconds * 1e6)}; }

private:
    static constexpr Ticks kLoop{10'000};
    ReceptionWatch watch_{kLease, kTick_ns};
    Tick now_{kLease.value};
};

TEST(ReceptionWatch, DoesNothingWhileAllPeersAreReceived) {
    Process process;
    process.run(3600);
    EXPECT_TRUE(process.reopened.empty());
}

TEST(ReceptionWatch, ReopensWhenAPeerThatIsThereStaysSilentForLongerThanItsLease) {
    Process process;
    process.run(10);
    process.found.is_peer_silent = true;
    process.run(2.9);
    EXPECT_TRUE(process.reopened.empty()) << "a peer that has just ended counts as present for its lease";
    process.run(1);
    ASSERT_EQ(process.reopened.size(), 1U);
    EXPECT_EQ(process.reopened[0].second, ReopenReason::PeerSilent);
}

TEST(ReceptionWatch, ReopensNeverLaterThanSevenSecondsAfterTheLastTimeWhileAPeerThatIsThereIsSilent) {
    Process process;
    process.found.is_peer_silent = true;
    process.run(60);
    ASSERT_GE(process.reopened.size(), 9U);
    for (std::size_t i = 1; i < process.reopened.size(); ++i) {
        const double pause = process.reopened[i].first - process.reopened[i - 1].first;
        EXPECT_GE(pause, 3.0);
        EXPECT_LE(pause, 7.0);
    }
}

TEST(ReceptionWatch, ReopensEverMoreSeldomForAPeerThatPerhapsDoesNotRun) {
    Process process;
    process.found.is_peer_missing = true;
    process.run(3600);
    ASSERT_GE(process.reopened.size(), 10U);
    EXPECT_LE(process.reopened.size(), 25U);
    EXPECT_LE(process.reopened[0].first, 8.0);
    EXPECT_EQ(process.reopened[0].second, ReopenReason::PeerMissing);
    EXPECT_NEAR(process.reopened[1].first - process.reopened[0].first, 6, 1);
    EXPECT_NEAR(process.reopened[2].first - process.reopened[1].first, 12, 1);
    const double last = process.reopened.back().first - process.reopened[process.reopened.size() - 2].first;
    EXPECT_NEAR(last, 192, 1);
}

TEST(ReceptionWatch, BeginsWithShortPausesAgainAfterAllPeersWereReceived) {
    Process process;
    process.found.is_peer_missing = true;
    process.run(1000);
    process.found.is_peer_missing = false;
    process.run(1);
    process.reopened.clear();
    process.found.is_peer_missing = true;
    process.run(7);
    EXPECT_EQ(process.reopened.size(), 1U);
}

TEST(ReceptionWatch, WaitsUntilTheProcessIsAtRest) {
    Process process;
    process.found = {.is_peer_silent = true, .may_reopen = false};
    process.run(60);
    EXPECT_TRUE(process.reopened.empty());
    process.found.may_reopen = true;
    process.run(0.6);
    EXPECT_EQ(process.reopened.size(), 1U);
}

TEST(ReceptionWatch, DoesNotCountItsOwnStallAsThePeersSilence) {
    Process process;
    process.run(10);
    for (int i = 0; i < 20; ++i) {
        process.found.is_peer_silent = true;
        process.run(1);
        process.stall(5);
    }
    EXPECT_TRUE(process.reopened.empty());
}

TEST(ReceptionWatch, ReopensWhenDdsDiscardsEverySampleOfATopic) {
    Process process;
    std::array<TopicReception, 2> topics{};
    process.found.topics = topics;
    process.run(10, [&] { topics[0].received += 10; });
    EXPECT_TRUE(process.reopened.empty());
    process.run(2, [&] {
        topics[0].received += 10;
        topics[1].discarded += 100;
    });
    ASSERT_EQ(process.reopened.size(), 1U);
    EXPECT_EQ(process.reopened[0].second, ReopenReason::SamplesDiscarded);
}

TEST(ReceptionWatch, IsNotDisturbedBySamplesThatWereSentAgain) {
    Process process;
    std::array<TopicReception, 1> topics{};
    process.found.topics = topics;
    int look = 0;
    process.run(100, [&] {
        topics[0].received += 1;  // a few new samples come, and many that were sent again
        topics[0].discarded += 100;
    });
    process.run(100, [&] { topics[0].discarded += ++look % 3 == 0 ? 0 : 100; });  // a repair now and then
    EXPECT_TRUE(process.reopened.empty());
}

TEST(ReceptionWatch, ReopensWhenThePeersReportForLongThatTheyDoNotReceiveThisProcess) {
    Process process;
    process.run(10);
    process.found.is_unreceived = true;
    process.run(2.9);
    EXPECT_TRUE(process.reopened.empty()) << "they need time to receive a process that has just started";
    process.run(1);
    ASSERT_EQ(process.reopened.size(), 1U);
    EXPECT_EQ(process.reopened[0].second, ReopenReason::NotReceivedByPeers);
    process.run(3.5);
    EXPECT_EQ(process.reopened.size(), 2U) << "once more, since it did not help";
}

TEST(ReceptionWatch, ReopensAtOnceOnAnInterfaceThatHasChanged) {
    Process process;
    process.run(10);
    process.found.change = ReopenReason::InterfaceChanged;
    process.run(0.6);
    ASSERT_EQ(process.reopened.size(), 1U);
    EXPECT_EQ(process.reopened[0].second, ReopenReason::InterfaceChanged);
}

}  // namespace
}  // namespace lockstep
