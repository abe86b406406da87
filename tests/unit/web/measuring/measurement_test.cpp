// A measurement of this server: from its order to its result, and to the values in which it is kept.
#include "clients/web/measuring/measurement.hpp"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include "clients/web/program/measure_reading.hpp"
#include "clients/web/state/measurement_document.hpp"
#include "tests/unit/session/two_axes.hpp"

namespace lockstep::web {
namespace {

using testing::HasSubstr;

MachineSetup mill() {
    MachineSetup machine = two_axes();
    machine.axes.push_back(example_axis("Z", 0, 100));
    machine.inputs = {{.name = "tip", .motor = "Z", .channel = 3, .use = InputUse::Probe, .number = 0}};
    return machine;
}

const ProgramStart kStart{{100, 0, 50}, {}};

MeasureOrder bore() {
    return {MeasureOptions{
        .kind = MeasureKind::Bore, .words = {}, .feed_mm_min = 60, .tip_mm = 2, .probe = {}, .diameter_mm = 20}};
}

MeasureOrder touch_of_z() { return {ProbeOptions{.move = {.targets = {"Z=40"}, .feed_mm_min = 60}, .probe = {}}}; }

Measurement measured(const MeasureOrder& order, const std::function<std::optional<double>(std::string_view)>& global) {
    const auto ready = ready_measurement(order, mill(), kStart);
    EXPECT_TRUE(ready) << ready.error().detail;
    const ProbeTouch touch{.touched = true, .places_mm = {100, 0, 41.5}, .rest_mm = {100, 0, 41.3}, .input = 0};
    const auto result = measure_result(mill(), *ready->measures, std::vector{touch}, global);
    EXPECT_TRUE(result);
    return {.number = 1,
            .plan = ready->measures,
            .touches = 1,
            .result = std::make_shared<const MeasureResult>(*result),
            .problem = {}};
}

std::optional<double> centre(std::string_view name) {
    return name == "_centre_x" ? 101 : name == "_centre_y" ? -2 : 20.04;
}

TEST(Measurements, OfABoreHaveItsCentreAndBecomeAZero) {
    const Measurement measurement = measured(bore(), centre);
    const auto json = measurement_document(measurement);
    EXPECT_EQ(json["kind"], "bore");
    EXPECT_EQ(json["result"]["x"], 101);
    EXPECT_EQ(json["result"]["diameter_y"], 20.04);
    EXPECT_EQ(json["result"]["input"], "tip");
    EXPECT_TRUE(json["result"]["angle_deg"].is_null() && json["problem"].is_null());
    const auto values = kept({.system = "G55", .tool = {}}, mill(), measurement, {});
    ASSERT_TRUE(values);
    EXPECT_DOUBLE_EQ(values->systems[1].origin[0], 101);
    EXPECT_DOUBLE_EQ(values->systems[1].origin[1], -2);
    EXPECT_EQ(kept({.system = "", .tool = 3}, mill(), measurement, {}).error().place, "/tool") << "it has no length";
}

TEST(Measurements, OfOneTouchHaveThePlaceOfEachAxis) {
    const Measurement measurement = measured(touch_of_z(), [](auto) { return std::nullopt; });
    const auto json = measurement_document(measurement);
    EXPECT_EQ(json["kind"], "touch");
    EXPECT_EQ(json["result"]["touch"]["Z"], 41.5);
    EXPECT_NEAR(json["result"]["behind"].get<double>(), 0.2, 1e-6);
    const auto values = kept({.system = "G54", .tool = {}, .reads_mm = 12}, mill(), measurement, {});
    ASSERT_TRUE(values);
    EXPECT_DOUBLE_EQ(values->systems[0].origin[2], 29.5);
    EXPECT_EQ(values->systems[0].origin[0], 0) << "X did not move";
}

TEST(Measurements, AreRefusedWithTheReasonBeforeAnythingMoves) {
    MachineSetup without = mill();
    without.inputs.clear();
    for (const MeasureOrder& order : {bore(), touch_of_z()}) {
        const auto ready = ready_measurement(order, without, kStart);
        ASSERT_FALSE(ready);
        EXPECT_EQ(ready.error().status, 422);
        EXPECT_THAT(ready.error().detail, HasSubstr("the machine has no probe"));
    }
    MeasureOrder thick = bore();
    std::get<MeasureOptions>(thick.what).tip_mm = 30;
    const auto ready = ready_measurement(thick, mill(), kStart);
    ASSERT_FALSE(ready);
    EXPECT_EQ(ready.error().place, "/tip");
    EXPECT_EQ(ready.error().detail, "tip is 30.000; it must be below the diameter, 20.000 mm");
}

TEST(Measurements, WithoutAResultAreNotKept) {
    EXPECT_EQ(kept({.system = "G54", .tool = {}}, mill(), std::nullopt, {}).error().code, "no-measurement");
    const auto ready = ready_measurement(bore(), mill(), kStart);
    ASSERT_TRUE(ready);
    EXPECT_EQ(measure_result(mill(), *ready->measures, {}, centre).error().code, "no-result");
}

}  // namespace
}  // namespace lockstep::web
