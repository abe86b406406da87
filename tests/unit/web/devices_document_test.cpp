// The document from which a page shows spindle, coolant, tool and outputs.
#include "clients/web/state/devices_document.hpp"

#include <gtest/gtest.h>

#include "clients/web/state/state_document.hpp"
#include "tests/unit/web/some_snapshot.hpp"

namespace lockstep::web {
namespace {

using Json = nlohmann::json;

TEST(DevicesDocument, ShowsThatAllIsOff) {
    EXPECT_EQ(devices_document({}), (Json{{"spindle", {{"direction", "stopped"}, {"rpm", 0.0}}},
                                          {"mist", false},
                                          {"flood", false},
                                          {"tool", nullptr},
                                          {"outputs", Json::array()}}));
}

TEST(DevicesDocument, ShowsWhatIsOn) {
    const ProgramDevices devices{.spindle = SpindleDirection::Reverse,
                                 .spindle_rpm = 799.96,
                                 .mist = true,
                                 .flood = true,
                                 .tool = 3,
                                 .outputs = 1ull << 63 | 0b101};
    EXPECT_EQ(devices_document(devices), (Json{{"spindle", {{"direction", "reverse"}, {"rpm", 800.0}}},
                                               {"mist", true},
                                               {"flood", true},
                                               {"tool", 3},
                                               {"outputs", {0, 2, 63}}}));
}

TEST(DevicesDocument, IsPartOfTheStateOnceItIsReceived) {
    Snapshot snapshot = snapshot_at_rest();
    snapshot.machine->value.devices.flood = true;
    EXPECT_EQ(state_document(snapshot, two_axes(), nullptr, {}, 1)["devices"]["flood"], true);
    EXPECT_TRUE(state_document({.axes = {{}, {}}}, two_axes(), nullptr, {}, 1)["devices"].is_null());
}

}  // namespace
}  // namespace lockstep::web
