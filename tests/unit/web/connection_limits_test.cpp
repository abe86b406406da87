// No client keeps others out, however many connections it opens and however slowly it sends and reads.
#include "clients/web/http/connection_limits.hpp"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <vector>

namespace lockstep::web {
namespace {

using namespace std::chrono_literals;
using testing::ElementsAre;
using testing::IsEmpty;
using Waits = ConnectionLimits::Waits;

class Limits : public testing::Test {
protected:
    static ConnectionLimits::Id id(std::size_t number) { return std::bit_cast<const void*>(number); }
    void begin(std::size_t number, const std::string& peer) { limits.begin(id(number), peer, 0s); }
    /// `count` connections from `first` on.
    void begin_many(std::size_t first, std::size_t count, const std::string& peer) {
        for (std::size_t i = first; i < first + count; ++i) { begin(i, peer); }
    }
    void forget_closed() {
        for (const std::size_t number : closed) { limits.forget(id(number)); }
        closed.clear();
    }

    std::vector<std::size_t> closed;
    ConnectionLimits limits{[this](ConnectionLimits::Id id) { closed.push_back(std::bit_cast<std::size_t>(id)); }};
};

TEST_F(Limits, TheOldestOfAnAddressWithTooManyIsClosed) {
    begin_many(1, ConnectionLimits::kMostUnknownOfAddress, "a");
    begin(1000, "b");
    EXPECT_THAT(closed, IsEmpty());
    begin_many(200, 2, "a");
    EXPECT_THAT(closed, ElementsAre(1, 2));
}

TEST_F(Limits, ManyOfOneAddressDoNotCloseThoseOfAnother) {
    begin(1, "operator");
    for (std::size_t i = 0; i < 10000; ++i) {
        begin(2 + i, i % 2 == 0 ? "a" : "b");
        for (const std::size_t number : closed) { EXPECT_NE(number, 1U); }
        forget_closed();
    }
}

TEST_F(Limits, ManyAddressesTogetherAreBounded) {
    std::size_t most = 0;
    std::size_t all_closed = 0;
    for (std::size_t i = 1; i <= 1000; ++i) {
        begin(i, "address " + std::to_string(i));
        for (const std::size_t number : closed) { EXPECT_NE(number, i) << "the newest may send its request"; }
        all_closed += closed.size();
        forget_closed();
        most = std::max(most, i - all_closed);
    }
    EXPECT_EQ(most, ConnectionLimits::kMostUnknown);
}

TEST_F(Limits, AConnectionThatIsSignedInIsNotClosedByUnknownOnes) {
    begin(1, "a");
    limits.wait(id(1), Waits::ForBody, 0, 0s);
    limits.sign_in(id(1));
    begin_many(2, 1000, "a");
    EXPECT_EQ(closed.size(), 1000 - ConnectionLimits::kMostUnknownOfAddress);
    EXPECT_EQ(closed.front(), 2U);
}

TEST_F(Limits, TheNewestThatIsSignedInStaysAndOneThatWaitsGoes) {
    for (std::size_t i = 1; i <= ConnectionLimits::kMostSignedIn; ++i) {
        begin(i, "a");
        limits.sign_in(id(i));
        limits.wait(id(i), i == 7 ? Waits::ForReader : Waits::ForServer, 0, 0s);
    }
    EXPECT_THAT(closed, IsEmpty());
    begin(1000, "a");
    limits.sign_in(id(1000));
    EXPECT_THAT(closed, ElementsAre(7));
    forget_closed();
    limits.wait(id(1000), Waits::ForServer, 0, 0s);
    begin(1001, "a");
    limits.sign_in(id(1001));
    EXPECT_THAT(closed, ElementsAre(1)) << "if all are served, the oldest goes";
}

TEST_F(Limits, EachStepOfARequestHasItsTime) {
    begin(1, "a");
    limits.close_late(9s);
    EXPECT_THAT(closed, IsEmpty());
    limits.wait(id(1), Waits::ForBody, 20 * ConnectionLimits::kLeastRate_bytes_s, 9s);
    limits.close_late(38s);
    EXPECT_THAT(closed, IsEmpty()) << "10 s, and 20 s for the bytes";
    limits.wait(id(1), Waits::ForServer, 0, 38s);
    limits.close_late(10000s);
    EXPECT_THAT(closed, IsEmpty()) << "the client is not to blame";
    limits.wait(id(1), Waits::ForReader, 0, 10000s);
    limits.close_late(10010s);
    limits.close_late(10011s);
    EXPECT_THAT(closed, ElementsAre(1)) << "once";
}

TEST_F(Limits, ASignedInConnectionMayBeIdleForLonger) {
    begin(1, "a");
    begin(2, "a");
    limits.sign_in(id(2));
    for (const std::size_t number : {1, 2}) { limits.wait(id(number), Waits::ForHead, 0, 0s); }
    limits.close_late(10s);
    EXPECT_THAT(closed, ElementsAre(1));
    limits.close_late(20s);
    EXPECT_THAT(closed, ElementsAre(1, 2));
}

TEST_F(Limits, AConnectionThatClosesIsNotCountedAgain) {
    begin_many(1, ConnectionLimits::kMostUnknownOfAddress + 1, "a");
    EXPECT_THAT(closed, ElementsAre(1));
    begin(2000, "b");
    EXPECT_THAT(closed, ElementsAre(1));
}

}  // namespace
}  // namespace lockstep::web
