// The state as events, and one viewer's stream of them.
#include "clients/web/state/event_stream.hpp"

#include <gtest/gtest.h>

#include <array>

namespace lockstep::web {
namespace {

using namespace std::chrono_literals;
using Json = nlohmann::json;

std::chrono::nanoseconds now_of_test{};

Json state(int value) { return {{"value", value}, {"same", true}}; }

class Events : public testing::Test {
protected:
    void SetUp() override { now_of_test = 0s; }
    void publish(int count) {
        for (int i = 0; i < count; ++i) { log.publish(state(++value)); }
    }
    EventStream stream(const std::string& last_id = "") {
        return {log, log.place_after(last_id), "s-1", [] { return now_of_test; }, [this] { ++ended; }};
    }
    static std::string read(EventStream& from) {
        std::string text;
        std::array<char, 7> some{};  // events come in pieces
        while (const std::size_t bytes = from.read(some).value_or(0)) { text.append(some.data(), bytes); }
        return text;
    }

    EventLog log{"run"};
    int value = 0;
    int ended = 0;
};

const std::string kStream = "retry: 1000\nevent: stream\ndata: {\"stream\":\"s-1\"}\n\n";

TEST_F(Events, BeginWithTheStreamsNameThenTheStateThenDifferences) {
    auto viewer = stream();
    EXPECT_EQ(read(viewer), kStream);
    publish(1);
    EXPECT_EQ(read(viewer), "event: state\nid: run-1\ndata: {\"same\":true,\"value\":1}\n\n");
    publish(2);
    EXPECT_EQ(read(viewer),
              "event: delta\nid: run-2\ndata: {\"value\":2}\n\nevent: delta\nid: run-3\ndata: {\"value\":3}\n\n");
    EXPECT_EQ(read(viewer), "");
}

TEST_F(Events, AnUnchangedStateIsNoEvent) {
    auto viewer = stream();
    publish(1);
    (void)read(viewer);
    log.publish(state(1));
    EXPECT_EQ(read(viewer), "");
}

TEST_F(Events, AViewerGoesOnBehindItsLastEvent) {
    publish(5);
    auto viewer = stream("run-4");
    EXPECT_EQ(read(viewer), kStream + "event: delta\nid: run-5\ndata: {\"value\":5}\n\n");
    auto newest = stream("run-5");
    EXPECT_EQ(read(newest), kStream);
}

TEST_F(Events, AnUnknownLastEventGetsTheWholeState) {
    publish(5);
    for (const char* id :
         {"", "run", "run-", "run-6", "run-x", "run-4x", "run--4", "other-4", "run-99999999999999999999"}) {
        auto viewer = stream(id);
        EXPECT_NE(read(viewer).find("event: state"), std::string::npos) << id;
    }
}

TEST_F(Events, OnlyTheLastEventsAreKept) {
    publish(1 + static_cast<int>(EventLog::kKept));
    EXPECT_EQ(log.place_after("run-1"), 2u);
    publish(1);
    EXPECT_EQ(log.place_after("run-1"), std::nullopt);
}

TEST_F(Events, AViewerThatDoesNotReadIsBehindAndCostsNothing) {
    auto viewer = stream();
    publish(1);
    (void)read(viewer);
    publish(static_cast<int>(EventLog::kKept));
    EXPECT_FALSE(viewer.is_behind());
    publish(1);
    EXPECT_TRUE(viewer.is_behind());
    EXPECT_EQ(read(viewer), "") << "it is told nothing false";
}

TEST_F(Events, AViewerThatHasNoStateYetIsNotBehind) {
    auto viewer = stream();
    EXPECT_FALSE(viewer.is_behind());
    publish(1000);
    EXPECT_FALSE(viewer.is_behind()) << "the whole state is always there";
}

TEST_F(Events, ACommentProvesTheConnectionWhileNothingChanges) {
    auto viewer = stream();
    (void)read(viewer);
    now_of_test = 4'999ms;
    EXPECT_EQ(read(viewer), "");
    now_of_test = 5s;
    EXPECT_EQ(read(viewer), ":\n\n");
    EXPECT_EQ(read(viewer), "");
}

TEST_F(Events, AStreamEndsOnce) {
    auto viewer = stream();
    viewer.end();
    viewer.end();
    EXPECT_EQ(ended, 1);
}

TEST_F(Events, BytesThatAreNoTextDoNotBreakThem) {
    auto viewer = stream();
    log.publish({{"name", "\xff\n\r"}});
    const std::string text = read(viewer).substr(kStream.size());
    EXPECT_EQ(std::ranges::count(text, '\n'), 4) << text;
}

}  // namespace
}  // namespace lockstep::web
