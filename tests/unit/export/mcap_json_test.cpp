// A sample is one JSON object with the names and values of its signals.
#include "clients/export/mcap_json.hpp"

#include <gtest/gtest.h>

#include <cstdlib>
#include <limits>

namespace lockstep::exporting {
namespace {

TEST(McapJson, ObjectHasTheValuesOfASampleInTheirOrder) {
    const Sample sample{"/mill/X/position",
                        1,
                        {{"position_mm", -1.25}, {"steps", std::int64_t{1} << 60}, {"state", std::string("Cruise")}}};
    EXPECT_EQ(json_of(sample), R"({"position_mm":-1.25,"steps":1152921504606846976,"state":"Cruise"})");
    EXPECT_EQ(json_schema_of(sample), R"({"type":"object","properties":{"position_mm":{"type":"number"},)"
                                      R"("steps":{"type":"integer"},"state":{"type":"string"}}})");
}

TEST(McapJson, DecimalsAreReadBackAsTheyWere) {
    for (const double value : {0.1, 1e22, -4.9e-324, 1.7976931348623157e308, 0.0}) {
        const std::string json = json_of({"/m/x", 1, {{"v", value}}});
        EXPECT_EQ(std::strtod(json.c_str() + 5, nullptr), value) << json;
    }
}

TEST(McapJson, LeavesOutValuesThatJsonCannotRepresent) {
    constexpr double kNone = std::numeric_limits<double>::quiet_NaN();
    constexpr double kEndless = std::numeric_limits<double>::infinity();
    EXPECT_EQ(json_of({"/m/x", 1, {{"a", kNone}, {"b", 2.5}, {"c", kEndless}}}), R"({"b":2.5})");
    EXPECT_EQ(json_of({"/m/x", 1, {{"a", kNone}}}), "{}");
}

TEST(McapJson, EscapesTextAndReplacesBytesThatAreNotPrintable) {
    EXPECT_EQ(json_of({"/m/x", 1, {{"a", std::string("say \"x\\y\"\n\xff")}}}), R"({"a":"say \"x\\y\"??"})");
}

}  // namespace
}  // namespace lockstep::exporting
