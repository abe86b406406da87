// When an axis asks for the time, and which replies complete an exchange.
#include "core/clock/clock_asker.hpp"

#include <gtest/gtest.h>

#include <vector>

namespace lockstep {
namespace {

constexpr Ticks kPeriod{50'000};

class Asking : public testing::Test {
protected:
    ClockAsker asker{2, 77, 1000};
    Tick now{1'000'000};

    ClockReply answered() {
        now += kPeriod;
        const auto request = asker.ask(now);
        EXPECT_TRUE(request);
        return {.request = request.value_or(ClockRequest{}), .received = Tick{500}, .answered = Tick{600}};
    }
};

TEST_F(Asking, AsksOnceInAPeriodAndAtOnceWhenItsClockWasSetBack) {
    const auto first = asker.ask(now);
    ASSERT_TRUE(first);
    EXPECT_EQ(*first, (ClockRequest{.axis = 2, .identity = 77, .sequence = 1, .sent = now}));
    EXPECT_FALSE(asker.ask(now + kPeriod - Ticks{1}));
    const auto second = asker.ask(now + kPeriod);
    ASSERT_TRUE(second);
    EXPECT_EQ(second->sequence, 2u);
    EXPECT_FALSE(asker.ask(now + kPeriod));
    EXPECT_TRUE(asker.ask(now)) << "otherwise it would not ask until its clock is as late as before";
}

TEST_F(Asking, AReplyCompletesItsExchangeOnce) {
    const ClockReply reply = answered();
    const auto exchange = asker.receive(reply, now + Ticks{900});
    ASSERT_TRUE(exchange);
    EXPECT_EQ(exchange->sent, now);
    EXPECT_EQ(exchange->received, Tick{500});
    EXPECT_EQ(exchange->answered, Tick{600});
    EXPECT_EQ(exchange->arrived, now + Ticks{900});
    EXPECT_FALSE(asker.receive(reply, now + Ticks{950})) << "a copy";
}

TEST_F(Asking, ARequestOfAnotherAxisOrProcessIsNotItsOwn) {
    ClockReply reply = answered();
    reply.request.axis = 1;
    EXPECT_FALSE(asker.receive(reply, now));
    reply.request.axis = 2;
    reply.request.identity = 78;
    EXPECT_FALSE(asker.receive(reply, now));
}

TEST_F(Asking, RemembersTheLastSixteenRequests) {
    std::vector<ClockReply> replies;
    for (int i = 0; i < 17; ++i) { replies.push_back(answered()); }
    EXPECT_FALSE(asker.receive(replies[0], now));
    for (std::size_t i = 1; i < replies.size(); ++i) { EXPECT_TRUE(asker.receive(replies[i], now)) << i; }
}

}  // namespace
}  // namespace lockstep
