// The table of the six states and Fault, walked completely: every state with every event.
#include "core/axis/state/fsm.hpp"

#include <gtest/gtest.h>

#include <array>
#include <set>

#include "core/protocol/names.hpp"

namespace lockstep {
namespace {

using P = AxisPhase;

// Rows: states, in the order Initialize, Standby, Accelerate, Cruise, Decelerate, Stop, Fault.
// Columns: SpeedRises, SpeedSteady, SpeedFalls, MotionEnds, SwitchStops, LimitStops, HostStops, PositionKept, Zeroed,
// Released, HomingBegins, Fails, ResetHomed, ResetUnhomed. A dash: the state ignores the event.
constexpr std::array<std::string_view, 7> kExpected{
    "- - - - T T T S S - I F - -", "A - - - - T T - - - I F - -", "- C D S - T T - - - - F - -",
    "A - D S - T T - - - - F - -", "A C - S - T T - - - - F - -", "- - - - - - - - S I I F - -",
    "- - - - - - - - - - - - S I",
};

char letter(std::optional<P> phase) {
    if (!phase) { return '-'; }
    constexpr std::string_view kLetters = "ISACDTF";
    return kLetters[static_cast<std::size_t>(*phase)];
}

TEST(AxisFsm, EveryStateAnswersEveryEventAsTheTableSays) {
    for (std::size_t s = 0; s < kAxisPhases.size(); ++s) {
        for (std::size_t e = 0; e < kAxisEvents; ++e) {
            EXPECT_EQ(letter(next_phase(kAxisPhases[s], static_cast<AxisEvent>(e))), kExpected[s][2 * e])
                << name_of(kAxisPhases[s]) << " with event " << e;
        }
    }
}

TEST(AxisFsm, NoPairIsListedTwice) {
    std::set<std::pair<P, AxisEvent>> seen;
    for (const AxisTransition& t : kAxisTransitions) { EXPECT_TRUE(seen.insert({t.from, t.event}).second); }
}

std::set<P> reachable_from(P start) {
    std::set<P> reached{start};
    for (bool grown = true; grown;) {
        grown = false;
        for (const AxisTransition& t : kAxisTransitions) {
            grown |= reached.contains(t.from) && reached.insert(t.to).second;
        }
    }
    return reached;
}

TEST(AxisFsm, EveryStateCanBeReachedFromEveryOther) {
    for (const P phase : kAxisPhases) { EXPECT_EQ(reachable_from(phase).size(), kAxisPhases.size()) << name_of(phase); }
}

TEST(AxisFsm, NothingMovesOutOfFaultButAReset) {
    for (std::size_t e = 0; e < kAxisEvents; ++e) {
        const auto event = static_cast<AxisEvent>(e);
        const bool reset = event == AxisEvent::ResetHomed || event == AxisEvent::ResetUnhomed;
        EXPECT_EQ(next_phase(P::Fault, event).has_value(), reset);
    }
}

}  // namespace
}  // namespace lockstep
