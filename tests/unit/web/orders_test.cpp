// Commands from the bodies of requests.
#include "clients/web/request/orders.hpp"

#include <gtest/gtest.h>

#include "tests/unit/session/two_axes.hpp"

namespace lockstep::web {
namespace {

template <typename T>
T order(std::string_view verb, std::string_view body) {
    const auto read = read_order(verb, body, two_axes());
    if (!read || !std::holds_alternative<T>(*read)) {
        ADD_FAILURE() << verb << " " << body << (read ? "" : ": " + read.error().detail);
        return {};
    }
    return std::get<T>(*read);
}

/// The status and place of the refusal.
std::string refusal(std::string_view verb, std::string_view body) {
    const auto read = read_order(verb, body, two_axes());
    return read ? "" : std::to_string(read.error().status) + " " + read.error().place;
}

TEST(Orders, PlainCommandsTakeAnEmptyBodyAndNoMembers) {
    const std::pair<const char*, CommandKind> plain[] = {{"hold", CommandKind::Hold},
                                                         {"resume", CommandKind::Resume},
                                                         {"stop", CommandKind::Stop},
                                                         {"estop", CommandKind::EmergencyStop},
                                                         {"reset", CommandKind::Reset}};
    for (const auto& [verb, kind] : plain) {
        EXPECT_EQ(order<Command>(verb, "").kind, kind);
        EXPECT_EQ(order<Command>(verb, "{}").kind, kind);
        EXPECT_EQ(refusal(verb, R"({"now":true})"), "400 /now");
    }
    EXPECT_TRUE(order<LeaseOrder>("take", "").takes);
    EXPECT_FALSE(order<LeaseOrder>("give", "").takes);
}

TEST(Orders, AResumeMayReturn) {
    EXPECT_FALSE(order<Command>("resume", "{}").returns);
    EXPECT_FALSE(order<Command>("resume", R"({"return":false})").returns);
    EXPECT_TRUE(order<Command>("resume", R"({"return":true})").returns);
    EXPECT_EQ(refusal("resume", R"({"return":1})"), "400 /return");
}

TEST(Orders, AnUnknownVerbIsRefusedWithTheKnownOnes) {
    const auto read = read_order("fly", "{}", two_axes());
    ASSERT_FALSE(read);
    EXPECT_EQ(read.error().status, 404);
    for (const std::string& verb : verbs()) { EXPECT_NE(read.error().limit.find(verb), std::string::npos) << verb; }
    EXPECT_EQ(refusal("", "{}"), "404 path");
    EXPECT_EQ(refusal("HOLD", "{}"), "404 path");
}

TEST(Orders, HomeTakesAxesByName) {
    EXPECT_TRUE(order<Command>("home", "{}").axes.empty());
    EXPECT_EQ(order<Command>("home", R"({"axes":["Y"]})").axes, AxisSet{AxisIndex{1}});
    EXPECT_EQ(refusal("home", R"({"axes":["Z"]})"), "422 /axes/0");
    EXPECT_EQ(refusal("home", R"({"axes":["X",1]})"), "400 /axes/1");
    EXPECT_EQ(refusal("home", R"({"axes":"X"})"), "400 /axes");
    EXPECT_EQ(refusal("home", R"({"axes":["X","X","X"]})"), "422 /axes");
}

TEST(Orders, AnOverrideNeedsOneOfItsValues) {
    const Command both = order<Command>("override", R"({"feed_percent":50,"rapid_percent":120})");
    EXPECT_EQ(both.feed_percent, 50);
    EXPECT_EQ(both.rapid_percent, 120);
    EXPECT_FALSE(order<Command>("override", R"({"rapid_percent":50})").feed_percent) << "as it is";
    EXPECT_EQ(refusal("override", "{}"), "400 /feed_percent");
    EXPECT_EQ(refusal("override", R"({"feed_percent":9})"), "422 /feed_percent");
    EXPECT_EQ(refusal("override", R"({"feed_percent":50.5})"), "400 /feed_percent");
}

TEST(Orders, AJogNamesEachAxisOnceWithinItsVelocity) {
    const JogOrder jog = order<JogOrder>(
        "jog",
        R"({"jogs":[{"axis":"X","velocity":-20},{"axis":"Y","velocity":5,"distance":2}],"stream":"s","press":3})");
    ASSERT_EQ(jog.jogs.size(), 2u);
    EXPECT_EQ(jog.jogs[0], (JogAxis{AxisIndex{0}, -20}));
    EXPECT_EQ(jog.jogs[1], (JogAxis{AxisIndex{1}, 5, 2}));
    EXPECT_EQ(jog.stream, "s");
    EXPECT_EQ(jog.press, 3u);
    EXPECT_TRUE(order<JogOrder>("jog", R"({"jogs":[]})").jogs.empty());
    EXPECT_EQ(refusal("jog", "{}"), "400 /jogs");
    EXPECT_EQ(refusal("jog", R"({"jogs":[1]})"), "400 /jogs/0");
    EXPECT_EQ(refusal("jog", R"({"jogs":[{"axis":"X"}]})"), "400 /jogs/0/velocity");
    EXPECT_EQ(refusal("jog", R"({"jogs":[{"axis":"X","velocity":0}]})"), "422 /jogs/0/velocity");
    EXPECT_EQ(refusal("jog", R"({"jogs":[{"axis":"X","velocity":151}]})"), "422 /jogs/0/velocity");
    EXPECT_EQ(refusal("jog", R"({"jogs":[{"axis":"X","velocity":1,"distance":0}]})"), "422 /jogs/0/distance");
    EXPECT_EQ(refusal("jog", R"({"jogs":[{"axis":"X","velocity":1},{"axis":"X","velocity":1}]})"), "422 /jogs/1/axis");
    EXPECT_EQ(refusal("jog", R"({"jogs":[],"press":0})"), "422 /press");
    EXPECT_FALSE(jog.is_step);
    EXPECT_TRUE(order<JogOrder>("jog", R"({"jogs":[{"axis":"X","velocity":1,"distance":1}],"step":true})").is_step);
    EXPECT_EQ(refusal("jog", R"({"jogs":[{"axis":"X","velocity":1}],"step":true})"), "422 /jogs/0/distance");
    EXPECT_EQ(refusal("jog", R"({"jogs":[{"axis":"X","velocity":1e-320}]})"), "422 /jogs/0/velocity");
    EXPECT_EQ(refusal("jog", R"({"jogs":[{"axis":"X","velocity":-9e-6}]})"), "422 /jogs/0/velocity");
    EXPECT_EQ(order<JogOrder>("jog", R"({"jogs":[{"axis":"X","velocity":-1e-5}]})").jogs.size(), 1u);
}

TEST(Orders, MdiIsOneLine) {
    EXPECT_EQ(order<MdiOrder>("mdi", R"({"line":"G0 X1"})").line, "G0 X1");
    EXPECT_EQ(refusal("mdi", "{}"), "400 /line");
    EXPECT_EQ(refusal("mdi", R"({"line":""})"), "422 /line");
    EXPECT_EQ(refusal("mdi", R"({"line":"G0 X1\nG0 X2"})"), "422 /line");
    EXPECT_EQ(refusal("mdi", "{\"line\":\"" + std::string(kMaxLine_bytes + 1, 'x') + "\"}"), "422 /line");
}

TEST(Orders, RunMayNameTheProgramThatItMeans) {
    EXPECT_EQ(order<RunOrder>("run", "{}").program, std::nullopt);
    EXPECT_EQ(order<RunOrder>("run", R"({"program":4})").program, 4u);
    EXPECT_EQ(refusal("run", R"({"program":0})"), "422 /program");
}

TEST(Orders, OffsetsAndTouchNameASystemAndLetters) {
    const TouchOrder touch = order<TouchOrder>("touch", R"({"axes":{"X":1.5}})");
    EXPECT_EQ(touch.system, 0u);
    EXPECT_EQ(touch.places, (Letters{{'X', 1.5}}));
    EXPECT_EQ(refusal("touch", "{}"), "400 /axes");
    EXPECT_EQ(refusal("touch", R"({"axes":{}})"), "422 /axes");
    EXPECT_EQ(refusal("touch", R"({"axes":{"Z":1}})"), "400 /axes/Z");
    const OffsetOrder offset = order<OffsetOrder>("offset", R"({"system":"G59.3","rotation_deg":-90})");
    EXPECT_EQ(offset.system, 8u);
    EXPECT_EQ(offset.rotation_deg, -90);
    EXPECT_EQ(refusal("offset", "{}"), "400 /system");
    EXPECT_EQ(refusal("offset", R"({"system":"G60"})"), "422 /system");
    EXPECT_EQ(refusal("offset", R"({"system":"G54","origin":{"X":2e6}})"), "422 /origin/X");
}

TEST(Orders, AToolIsSetOrRemoved) {
    const ToolOrder tool = order<ToolOrder>("tool", R"({"number":3,"pocket":2,"offset":{"Y":1},"diameter":6})");
    EXPECT_EQ(tool.number, 3);
    EXPECT_EQ(tool.pocket, 2);
    EXPECT_EQ(tool.diameter, 6);
    EXPECT_FALSE(tool.removes);
    EXPECT_TRUE(order<ToolOrder>("tool", R"({"number":3,"remove":true})").removes);
    EXPECT_EQ(refusal("tool", R"({"number":3,"remove":true,"pocket":1})"), "422 /remove");
    EXPECT_EQ(refusal("tool", R"({"number":0})"), "422 /number");
    EXPECT_EQ(refusal("tool", R"({"number":1,"diameter":-1})"), "422 /diameter");
}

TEST(Orders, AnAnswerNamesTheJobAndWhetherItJogs) {
    EXPECT_EQ(accepted_json({}), (Json{{"accepted", true}, {"job", nullptr}}));
    EXPECT_EQ(accepted_json({.job = 3, .jogging = false}), (Json{{"accepted", true}, {"job", 3}, {"jogging", false}}));
}

}  // namespace
}  // namespace lockstep::web
