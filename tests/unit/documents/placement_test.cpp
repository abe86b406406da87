// Which part of a machine runs on which host: one file for all hosts.
#include "services/documents/placement.hpp"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

namespace lockstep {
namespace {

using testing::ElementsAre;
using testing::HasSubstr;

/// The coordinator and X on "mill"; Y and Z on their own boards; a turntable without a host.
MachineSetup boards() {
    MachineSetup machine{{.name = "mill"}};
    machine.coordinator_host = "mill.lan";
    machine.axes = {{.name = "X", .host = "mill"},
                    {.name = "Y", .host = "Board-Y"},
                    {.name = "Z", .host = "board-z.lan"},
                    {.name = "T"}};
    return machine;
}

TEST(Placement, ContainsThePartsPlacedOnAHostAndThosePlacedNowhere) {
    const Placement mill = placed_on(boards(), "mill");
    EXPECT_TRUE(mill.coordinator);
    EXPECT_THAT(mill.axes, ElementsAre(0, 3));
    const Placement board = placed_on(boards(), "board-y");
    EXPECT_FALSE(board.coordinator);
    EXPECT_THAT(board.axes, ElementsAre(1, 3));
}

TEST(Placement, NamesOfAHostDifferInCapitalsAndByItsDomain) {
    EXPECT_TRUE(same_host("Board-Z", "board-z.lan"));
    EXPECT_FALSE(same_host("board-z.shop", "board-z.lan"));
    EXPECT_FALSE(same_host("board", "board-z"));
    EXPECT_THAT(hosts_of(boards()), ElementsAre("mill.lan", "Board-Y", "board-z.lan"));
}

TEST(AxisToRun, IsTheNamedOneOrTheOnlyOneOfThisHost) {
    EXPECT_EQ(axis_to_run(boards(), "Z", "mill"), 2U);
    EXPECT_EQ(axis_to_run(boards(), "", "board-y"), 1U);
}

TEST(AxisToRun, ListsTheAxesIfNoneOrSeveralFit) {
    EXPECT_THAT(axis_to_run(boards(), "W", "mill").error(), HasSubstr("no axis W; it has: X (mill) Y (Board-Y)"));
    EXPECT_THAT(axis_to_run(boards(), "", "laptop").error(), HasSubstr("no axis on this host, laptop"));
    MachineSetup two = boards();
    two.axes[1].host = "mill";
    EXPECT_THAT(axis_to_run(two, "", "mill").error(), HasSubstr("several axes on this host, mill: X Y; name one"));
}

}  // namespace
}  // namespace lockstep
