// Both ends of a clock exchange read their clocks when a message is here for certain: no message looks received before
// it was sent, also if it comes behind the one that woke the thread.
#include "services/wire/bus/clock_link.hpp"

#include <gtest/gtest.h>

#include <atomic>
#include <vector>

#include "tests/integration/wire/eventually.hpp"
#include "tests/integration/wire/own_network.hpp"

namespace lockstep {
namespace {

constexpr std::size_t kExchanges = 50;
constexpr std::int64_t kTick_ns = 1000;

class ClockLink : public testing::Test {
protected:
    Participant open(const Membership& membership = {}) const {
        auto participant = Participant::open(network_, "mill", membership);
        if (!participant) { throw std::runtime_error(participant.error()); }
        return *std::move(participant);
    }
    /// The one clock of both ends. Each reading is later than the one before.
    Tick read(std::int64_t passed = 1) { return Tick{time_ += passed}; }

private:
    NetworkConfig network_ = own_network();
    std::atomic<std::int64_t> time_ = 0;
};

TEST_F(ClockLink, ARequestIsReceivedAfterItWasSent) {
    Participant coordinator = open();
    Participant axis = open({.axis = 0, .credentials = {}});
    Writer<ClockRequest> first(axis);
    Writer<ClockRequest> next(axis);  // used by the server's thread
    Reader<ClockReply> replies(axis);
    std::atomic<std::uint64_t> sequence = 0;
    const auto ask = [&](Writer<ClockRequest>& by) {
        (void)by.write({.axis = 0, .identity = 7, .sequence = ++sequence, .sent = read()});
    };
    // While the server reads its clock, the next request comes.
    const ClockServer server(coordinator, [&] {
        const Tick now = read();
        if (sequence < kExchanges) { ask(next); }
        return now;
    });
    ASSERT_TRUE(eventually([&] { return first.matched() > 0 && next.matched() > 0 && replies.matched() > 0; }));
    ask(first);
    std::size_t answered = 0;
    ASSERT_TRUE(eventually([&] {
        (void)replies.take([&](ClockReply&& reply) {
            ++answered;
            EXPECT_GT(reply.received, reply.request.sent);
            EXPECT_GE(reply.answered, reply.received);
        });
        return sequence >= kExchanges && answered > 0;
    }));
}

TEST_F(ClockLink, AReplyArrivesAfterItWasAnswered) {
    Participant coordinator = open();
    Participant axis = open({.axis = 0, .credentials = {}});
    Reader<ClockRequest> requests(coordinator);
    Writer<ClockReply> replies(coordinator);
    // While the client reads its clock, an answer to its last request comes. Each reading is time to ask again.
    ClockClient client(axis, ClockAsker(0, 7, kTick_ns), [&] {
        const Tick now = read(static_cast<std::int64_t>(ClockAsker::kPeriod_s * 1e9) / kTick_ns);
        (void)requests.take([&](ClockRequest&& request) {
            const Tick received = read();
            (void)replies.write({request, received, read()});
        });
        return now;
    });
    std::vector<ClockExchange> exchanges;
    std::size_t known = 0;
    ASSERT_TRUE(eventually([&] {
        client.take(exchanges);
        for (const ClockExchange& exchange : exchanges) { EXPECT_GT(exchange.arrived, exchange.answered); }
        known += exchanges.size();
        return known >= kExchanges;
    }));
}

}  // namespace
}  // namespace lockstep
