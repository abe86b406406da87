// Each incident is reported by itself, also if the same files contain several.
#include <gmock/gmock.h>

#include "tests/unit/incident/flown_machine.hpp"

namespace lockstep {
namespace {

using incident::CauseKind;
using incident::Evaluation;
using incident::Incident;
using testing::HasSubstr;

class Separated : public FlownMachine {
protected:
    std::vector<Incident> incidents() const { return incident::incidents_of(files()); }
    std::vector<Evaluation> evaluations() const {
        std::vector<Evaluation> found;
        for (const Incident& one : incidents()) { found.push_back(incident::evaluate(one)); }
        return found;
    }
    void stop_at_once() {
        (void)ask(CommandKind::EmergencyStop);
        wait(0.3);
    }
    void reset() {
        (void)ask(CommandKind::Reset);
        ASSERT_TRUE(reaches(MachinePhase::Idle, 5)) << describe();
    }
};

TEST_F(Separated, AnEmergencyStopAtRestAndOneInMotionAreTwoIncidents) {
    home();
    stop_at_once();
    reset();
    start_job();
    stop_at_once();
    const auto found = evaluations();
    ASSERT_EQ(found.size(), 2U);
    for (const Evaluation& one : found) {
        EXPECT_EQ(one.cause.kind, CauseKind::EmergencyStop) << testing::PrintToString(one.story);
    }
    EXPECT_EQ(found[0].story[2], "no axis was moving");
    EXPECT_TRUE(found[0].moving.empty());
    EXPECT_THAT(found[1].story[2], HasSubstr("axis X and axis Y were moving; all axes at rest"));
    EXPECT_EQ(found[1].moving, (MotorSet{MotorIndex{kX}, MotorIndex{kY}}));
    EXPECT_TRUE(found[1].rest);
}

TEST_F(Separated, EveryNoteIsInExactlyOneIncident) {
    home();
    stop_at_once();
    reset();
    start_job();
    stop_at_once();
    std::size_t noted = 0;
    for (const VirtualFlight& flight : *flights) { noted += flight.events.size(); }
    std::size_t listed = 0;
    for (const Incident& one : incidents()) {
        EXPECT_TRUE(one.absent.empty());
        listed += one.timeline.size();
    }
    EXPECT_EQ(listed, noted);
}

TEST_F(Separated, OnlyTheAxisThatMovesIsNamed) {
    home();
    ASSERT_EQ(run(program_of({{85, 5}}, 40)).status, ReplyStatus::Accepted);
    wait(0.8);
    stop_at_once();
    EXPECT_THAT(evaluations().back().story[2], testing::StartsWith("axis X was moving; all axes at rest"));
}

TEST_F(Separated, TwoStopsBeforeAResetAreOneIncident) {
    start_job();
    stop_at_once();
    wait(3);
    stop_at_once();
    const auto found = evaluations();
    ASSERT_EQ(found.size(), 1U);
    EXPECT_FALSE(found[0].moving.empty());
}

TEST_F(Separated, AnInterruptionAndALaterFaultAreTwoIncidents) {
    start_job();
    inject({.kind = Kind::Freeze, .process = kY, .lasts = seconds(0.006)});
    wait(0.5);
    ASSERT_TRUE(any_incident());
    ASSERT_EQ(vm.state()->phase, MachinePhase::Running) << describe();
    vm.device(kX).plant().push(9'000);
    wait(1);
    const auto found = evaluations();
    ASSERT_EQ(found.size(), 2U);
    EXPECT_EQ(found[0].cause.kind, CauseKind::Stalled) << testing::PrintToString(found[0].story);
    EXPECT_EQ(found[1].cause.kind, CauseKind::Fault) << testing::PrintToString(found[1].story);
}

TEST_F(Separated, AnAbsenceAndALaterStallAreTwoIncidents) {
    home();
    inject({.kind = Kind::Crash, .process = kY, .lasts = seconds(0.3)});
    wait(2);
    (void)ask(CommandKind::Reset);
    wait(0.5);
    start_job();
    inject({.kind = Kind::Freeze, .process = kX, .lasts = seconds(0.02)});
    wait(1);
    const auto found = evaluations();
    ASSERT_EQ(found.size(), 2U);
    EXPECT_EQ(found[0].cause.kind, CauseKind::Ended) << testing::PrintToString(found[0].story);
    EXPECT_EQ(found[0].cause.who, flight_axis(MotorIndex{kY}));
    EXPECT_EQ(found[1].cause.kind, CauseKind::Stalled) << testing::PrintToString(found[1].story);
    EXPECT_EQ(found[1].cause.who, flight_axis(MotorIndex{kX}));
    EXPECT_FALSE(found[1].moving.empty());
}

struct Injected {
    const char* name;
    VirtualFault fault;
};

class OneFault : public FlownMachine, public testing::WithParamInterface<Injected> {};

/// Every process notices a fault in its own way and at its own time.
TEST_P(OneFault, InMotionIsOneIncident) {
    start_job();
    inject(GetParam().fault);
    wait(3);
    ASSERT_TRUE(any_incident());
    EXPECT_EQ(incident::incidents_of(files()).size(), 1U);
}

TEST_P(OneFault, AtRestIsAtMostOneIncident) {
    home();
    inject(GetParam().fault);
    wait(3);
    EXPECT_LE(incident::incidents_of(files()).size(), 1U);
}

using Faulty = VirtualFault::Kind;
INSTANTIATE_TEST_SUITE_P(
    Kinds, OneFault,
    testing::Values(Injected{"AShortStall", {.kind = Faulty::Freeze, .process = 1, .lasts = {6'000}}},
                    Injected{"AStall", {.kind = Faulty::Freeze, .process = 1, .lasts = {100'000}}},
                    Injected{"ALongStall", {.kind = Faulty::Freeze, .process = 1, .lasts = {1'500'000}}},
                    Injected{"AStallOfTheCoordinator", {.kind = Faulty::Freeze, .process = 2, .lasts = {100'000}}},
                    Injected{"ALongStallOfTheCoordinator",
                             {.kind = Faulty::Freeze, .process = 2, .lasts = {1'500'000}}},
                    Injected{"AShortEnd", {.kind = Faulty::Crash, .process = 1, .lasts = {100'000}}},
                    Injected{"ALongEnd", {.kind = Faulty::Crash, .process = 1, .lasts = {1'500'000}}},
                    Injected{"AnEndOfTheCoordinator", {.kind = Faulty::Crash, .process = 2, .lasts = {500'000}}},
                    Injected{"ACut", {.kind = Faulty::Cut, .process = 0, .lasts = {100'000}}},
                    Injected{"ALongCut", {.kind = Faulty::Cut, .process = 0, .lasts = {1'500'000}}},
                    Injected{"ACutOfOneLink", {.kind = Faulty::Cut, .process = 0, .lasts = {1'500'000}, .peer = 1}}),
    [](const auto& injected) { return std::string(injected.param.name); });

}  // namespace
}  // namespace lockstep
