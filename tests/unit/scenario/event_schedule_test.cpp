// Scripted events are due at their trigger, in the order written, and never before.
#include "clients/scenario/model/event_schedule.hpp"

#include "tests/unit/scenario/scenario_text.hpp"

namespace lockstep::scenario {
namespace {

/// A step with its scripted events, on axes X and Y.
class ScheduledRun {
public:
    explicit ScheduledRun(const std::string& during)
        : scenario_(parsed(whole("step { run { gcode: \"G4 P1\\nG4 P1\\nG4 P1\" } " + during + " }"))),
          schedule_(scenario_.asked.step(1), {"X", "Y"}) {}

    /// The processes that are killed now.
    std::string killed(const Moment& now) {
        std::string names;
        while (const auto* during = schedule_.next(now)) { names += during->act().kill() + " "; }
        return names;
    }
    int done() const { return schedule_.done(); }

private:
    Scenario scenario_;
    EventSchedule schedule_;
};

Moment at(double s) { return {.since_begun_s = s, .phase = MachinePhase::Running, .line = 1, .at_mm = {{0}, {0}}}; }
Moment at_x(double s, double mm) {
    Moment now = at(s);
    now.at_mm[0] = mm;
    return now;
}
Moment in_line(double s, int line) {
    Moment now = at(s);
    now.line = line;
    return now;
}

TEST(EventScheduleTest, CountsFromStartOfJobWithoutTrigger) {
    ScheduledRun job("during { after_s: 0.5 act { kill: \"axis-X\" } }");
    EXPECT_EQ(job.killed(at(0.4)), "");
    EXPECT_EQ(job.killed(at(0.5)), "axis-X ");
    EXPECT_EQ(job.killed(at(0.6)), "") << "each event is due once";
}

TEST(EventScheduleTest, CountsFromTrigger) {
    ScheduledRun job("during { line: 2 after_s: 0.2 act { kill: \"axis-X\" } }");
    EXPECT_EQ(job.killed(in_line(1.0, 1)), "");
    EXPECT_EQ(job.killed(in_line(1.1, 2)), "");
    EXPECT_EQ(job.killed(in_line(1.2, 3)), "");
    EXPECT_EQ(job.killed(in_line(1.31, 3)), "axis-X ");
}

TEST(EventScheduleTest, DetectsPassageInBothDirectionsBetweenSamples) {
    for (const auto& [from, to] : {std::pair{9.0, 11.0}, {11.0, 9.0}, {9.0, 10.0}}) {
        ScheduledRun job("during { passes { axis: \"X\" mm: 10 } act { kill: \"axis-Y\" } }");
        EXPECT_EQ(job.killed(at_x(0, from)), "");
        EXPECT_EQ(job.killed(at_x(0.1, to)), "axis-Y ");
    }
}

TEST(EventScheduleTest, DetectsNoPassageWithoutPosition) {
    ScheduledRun job("during { passes { axis: \"X\" mm: 10 } act { kill: \"axis-Y\" } }");
    Moment without_position = at(0);
    without_position.at_mm[0] = std::nullopt;
    EXPECT_EQ(job.killed(at_x(0, 9)), "");
    EXPECT_EQ(job.killed(without_position), "");
    EXPECT_EQ(job.killed(at_x(0.2, 11)), "");
}

TEST(EventScheduleTest, KeepsTheOrderWritten) {
    ScheduledRun job(
        "during { phase: HOLDING act { kill: \"axis-X\" } } during { after_s: 0.1 act { kill: \"axis-Y\" } }");
    EXPECT_EQ(job.killed(at(0.2)), "") << "the second waits for the first";
    Moment holding = at(0.3);
    holding.phase = MachinePhase::Holding;
    EXPECT_EQ(job.killed(holding), "axis-X axis-Y ");
}

TEST(EventScheduleTest, CountsEventsThatWereDue) {
    ScheduledRun job("during { act { kill: \"axis-X\" } } during { line: 3 act { kill: \"axis-Y\" } }");
    EXPECT_EQ(job.killed(at(0)), "axis-X ");
    EXPECT_EQ(job.killed(at(100)), "");
    EXPECT_EQ(job.done(), 1);
}

}  // namespace
}  // namespace lockstep::scenario
