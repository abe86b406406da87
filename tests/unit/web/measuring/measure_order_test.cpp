// Orders to measure with a probe, from the bodies of requests.
#include "clients/web/request/measure_order.hpp"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include "clients/web/request/orders.hpp"
#include "tests/unit/session/two_axes.hpp"

namespace lockstep::web {
namespace {

using testing::ElementsAre;

template <typename T>
T what_of(std::string_view body) {
    const auto read = read_order("probe", body, two_axes());
    if (!read || !std::holds_alternative<T>(std::get<MeasureOrder>(*read).what)) {
        ADD_FAILURE() << body << (read ? "" : ": " + read.error().detail);
        return {};
    }
    return std::get<T>(std::get<MeasureOrder>(*read).what);
}

/// The status and place of the refusal.
std::string place_of_refusal(std::string_view verb, std::string_view body) {
    const auto read = read_order(verb, body, two_axes());
    return read ? "" : std::to_string(read.error().status) + " " + read.error().place;
}

TEST(MeasureOrders, OfOneTouchAreThatOfTheCommand) {
    const auto touch =
        what_of<ProbeOptions>(R"({"kind":"touch","to":{"X":-5},"feed":60,"relative":true,"may_miss":true,"probe":2})");
    EXPECT_THAT(touch.move.targets, ElementsAre("X=-5"));
    EXPECT_EQ(touch.move.feed_mm_min, 60);
    EXPECT_TRUE(touch.move.relative && touch.may_miss && !touch.away);
    EXPECT_EQ(touch.probe, 2);
}

TEST(MeasureOrders, OfSeveralTouchesAreThoseOfTheCommand) {
    const auto corner =
        what_of<MeasureOptions>(R"({"kind":"corner","way":{"X":10,"Y":-8.5},"beside":5,"tip":2,"feed":60,"back":0.5})");
    EXPECT_EQ(corner.kind, MeasureKind::Corner);
    EXPECT_THAT(corner.words, ElementsAre("X=10", "Y=-8.5"));
    EXPECT_EQ(corner.clearance_mm, 5);
    EXPECT_EQ(corner.back_mm, 0.5);
    const auto surface = what_of<MeasureOptions>(
        R"({"kind":"surface","from":{"X":10,"Y":20},"to":{"X":90,"Y":60},"spacing":20,"down":5,"feed":60})");
    EXPECT_THAT(surface.words, ElementsAre("X=10:90", "Y=20:60"));
    EXPECT_EQ(surface.back_mm, 1) << "as lockstep probe has it";
}

TEST(MeasureOrders, MissWhatTheirKindNeeds) {
    EXPECT_EQ(place_of_refusal("probe", R"({"feed":60})"), "400 /kind");
    EXPECT_EQ(place_of_refusal("probe", R"({"kind":"hole","feed":60})"), "422 /kind");
    EXPECT_EQ(place_of_refusal("probe", R"({"kind":"bore","feed":60,"tip":2})"), "400 /diameter");
    EXPECT_EQ(place_of_refusal("probe", R"({"kind":"edge","feed":60,"tip":2})"), "400 /way");
    EXPECT_EQ(place_of_refusal("probe", R"({"kind":"touch","to":{},"feed":60})"), "422 /to");
    EXPECT_EQ(place_of_refusal("probe", R"({"kind":"touch","to":{"X":1},"feed":0})"), "422 /feed");
    EXPECT_EQ(place_of_refusal("probe", R"({"kind":"bore","diameter":9,"tip":2,"feed":60,"down":1})"), "400 /down")
        << "a bore has no way down";
}

TEST(MeasureOrders, AreKeptInASystemOrInATool) {
    const auto keep = [](std::string_view body) {
        return std::get<KeepOrder>(read_order("keep", body, two_axes()).value());
    };
    EXPECT_EQ(keep(R"({"system":"G55","reads":1.5})").system, "G55");
    EXPECT_EQ(keep(R"({"system":"G55","reads":1.5})").reads_mm, 1.5);
    EXPECT_EQ(keep(R"({"tool":3})").tool, 3);
    EXPECT_EQ(place_of_refusal("keep", "{}"), "400 /system");
    EXPECT_EQ(place_of_refusal("keep", R"({"system":"G60"})"), "422 /system");
    EXPECT_EQ(place_of_refusal("keep", R"({"system":"G54","tool":1})"), "422 /tool");
}

}  // namespace
}  // namespace lockstep::web
