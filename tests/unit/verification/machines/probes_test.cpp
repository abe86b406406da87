// The recorded touches of probes are compared with the frames that were run.
#include <gtest/gtest.h>

#include "clients/verification/verification.hpp"
#include "tests/unit/verification/altered_log.hpp"
#include "tests/unit/verification/recorded_machine.hpp"

namespace lockstep::verification {
namespace {

class RecordedProbes : public testing::Test {
protected:
    static std::filesystem::path path() { return test::test_directory() / "probes.lcm"; }

    /// A touch of one of two inputs, and a move that misses.
    static void record() {
        MachineSetup machine = test::example("two-axis");
        machine.inputs = {
            {.name = "probe", .motor = "Y", .channel = 3, .use = InputUse::Probe, .number = 0, .max_overshoot_mm = 20},
            {.name = "ring", .motor = "X", .channel = 4, .use = InputUse::Probe, .number = 0, .max_overshoot_mm = 20}};
        test::RecordedMachine recorded(machine, path());
        recorded.home();
        std::vector<double> at = parked_mm(machine);
        recorded.begin(probe({at[0] + 40, at[1] + 20}, at, true));
        recorded.advance_ms(1500);
        recorded.vm().set_input(0, true);
        recorded.advance_ms(40);
        recorded.vm().set_input(1, true);
        ASSERT_TRUE(recorded.reaches(MachinePhase::Idle));
        ASSERT_TRUE(recorded.vm().state()->probe && recorded.vm().state()->probe->touched());
        for (const std::size_t input : {0, 1}) { recorded.vm().set_input(input, false); }
        recorded.advance_ms(100);
        for (std::size_t i = 0; i < at.size(); ++i) {
            at[i] =
                static_cast<double>(recorded.vm().axis_states()[i]->position.count()) / machine.axes[i].steps_per_mm;
        }
        recorded.begin(probe({at[0] + 1, at[1]}, at, false));
        ASSERT_TRUE(recorded.reaches(MachinePhase::Idle));
        ASSERT_FALSE(recorded.vm().state()->probe->touched());
    }
    /// A move of X alone, or of both axes with the same switch, whose pulses cease at the touch.
    static void record_ceasing(std::vector<std::string> motors = {"X"}) {
        MachineSetup machine = test::example("two-axis");
        for (const std::string& motor : motors) {
            machine.inputs.push_back({.name = "probe_" + motor,
                                      .motor = motor,
                                      .channel = 3,
                                      .use = InputUse::Probe,
                                      .number = 0,
                                      .wire = motors.size() > 1 ? "tip" : ""});
        }
        test::RecordedMachine recorded(machine, path());
        recorded.home();
        const std::vector<double> at = parked_mm(machine);
        recorded.begin(probe({at[0] + 30, at[1] + (motors.size() > 1 ? 15 : 0)}, at, true, true));
        recorded.advance_ms(900);
        for (std::size_t i = 0; i < motors.size(); ++i) { recorded.vm().set_input(i, true); }
        ASSERT_TRUE(recorded.reaches(MachinePhase::Idle));
        ASSERT_TRUE(recorded.vm().state()->probe && recorded.vm().state()->probe->touched());
    }
    static Program probe(std::vector<double> to, std::vector<double> from, bool must, bool is_feed_fixed = false) {
        Program program{.name = "probe.gcode", .axes = {"X", "Y"}, .start_mm = std::move(from), .blocks = {}};
        program.blocks.push_back({1, Probe{.must_touch = must}});
        program.blocks.push_back(
            {1, ProgramMove{.target_mm = std::move(to), .feed_mm_s = 10, .is_feed_fixed = is_feed_fixed}});
        return program;
    }
    static Findings altered(const std::function<void(job_t&)>& change, const std::string& outcome = "touched") {
        test::AlteredLog log(path());
        EXPECT_EQ(log.change<job_t>("_JOB",
                                    [&](job_t& job) {
                                        const bool is_it = job.event == "probe" && job.outcome == outcome;
                                        if (is_it) { change(job); }
                                        return is_it;
                                    }),
                  1);
        return verify_log(log.write(test::test_directory() / "altered.lcm")).value();
    }
    static bool closes(const channel_event_t& event, const std::string& motor) {
        return event.kind == "input" && event.closed != 0 && event.channel >= 3 && event.axis == motor;
    }
    /// The change with which the probe's input of this motor closed.
    static Findings altered_input(const std::string& motor, const std::function<void(channel_event_t&)>& change) {
        test::AlteredLog log(path());
        EXPECT_EQ(log.change<channel_event_t>("_CHANNELS",
                                              [&](channel_event_t& event) {
                                                  if (!closes(event, motor)) { return false; }
                                                  change(event);
                                                  return true;
                                              }),
                  1);
        return verify_log(log.write(test::test_directory() / "altered.lcm")).value();
    }
    static void expect_exact() {
        const Findings findings = verify_log(path()).value();
        EXPECT_FALSE(findings.difference) << findings.difference->text;
        EXPECT_TRUE(findings.is_exact());
    }
    /// The pulses of this motor ceased some steps later.
    static Findings ceased_later(const std::string& motor) {
        test::AlteredLog log(path());
        EXPECT_EQ(log.change<run_t>("_" + motor + "_RUN",
                                    [](run_t& run) {
                                        const bool has_ceased = run.cut != 0 && run.epoch != 0;
                                        run.stop_count += has_ceased ? 2 : 0;
                                        return has_ceased;
                                    }),
                  1);
        return verify_log(log.write(test::test_directory() / "altered.lcm")).value();
    }
    static void expect_difference(const Findings& findings, const std::string& text) {
        ASSERT_TRUE(findings.difference);
        EXPECT_NE(findings.difference->text.find(text), std::string::npos) << findings.difference->text;
    }
};

TEST_F(RecordedProbes, AreExactIfTheirPlacesAreThoseOfTheFrames) {
    record();
    const Findings findings = verify_log(path()).value();
    EXPECT_FALSE(findings.difference) << findings.difference->text;
    EXPECT_TRUE(findings.is_exact());
    EXPECT_EQ(findings.jobs, 2U);
}

TEST_F(RecordedProbes, AreNotExactElsewhereOrAtAnotherTick) {
    record();
    const Findings place = altered([](job_t& job) { job.start_count[0] += 5000; });
    ASSERT_TRUE(place.difference);
    EXPECT_NE(place.difference->text.find("the touch at tick"), std::string::npos) << place.difference->text;
    const Findings time = altered([](job_t& job) { job.start_tick -= 1000; });
    EXPECT_TRUE(time.difference);
}

TEST_F(RecordedProbes, NameTheInputThatTouchedFirst) {
    record();
    std::vector<std::string> named;
    (void)altered([&](job_t& job) { named.push_back(job.program); });
    EXPECT_EQ(named, std::vector<std::string>{"probe"});
    expect_difference(altered([](job_t& job) { job.program = "ring"; }), "of input ring at tick");
    EXPECT_TRUE(altered([](job_t& job) { job.program.clear(); }).is_exact());  // an earlier version
}

TEST_F(RecordedProbes, AreNotExactIfAnInputTouchedEarlierOrNoneThen) {
    record();
    EXPECT_TRUE(altered_input("Y", [](channel_event_t&) {}).is_exact());
    expect_difference(altered_input("X", [](channel_event_t& event) { event.tick -= 60'000; }),
                      "input ring touched earlier");
    expect_difference(altered_input("Y", [](channel_event_t& event) { --event.tick; }), "input probe touched earlier");
    expect_difference(altered_input("Y", [](channel_event_t& event) { ++event.tick; }), "none of them touched then");
    expect_difference(altered_input("Y", [](channel_event_t& event) { event.closed = 0; }), "none of them touched");
}

TEST_F(RecordedProbes, AreNotExactIfATouchIsRecordedAsMissed) {
    record();
    expect_difference(altered([](job_t& job) {
                          job.outcome = "missed";
                          job.program.clear();
                          job.start_tick = 0;
                      }),
                      "without a touch, but by the record of its inputs, input probe touched");
}

TEST_F(RecordedProbes, RestWhereTheirPulsesHadToCease) {
    record_ceasing();
    expect_exact();
    expect_difference(ceased_later("X"), "its pulses had to cease at step");
}

TEST_F(RecordedProbes, RestWhereThePulsesOfEachMotorHadToCease) {
    record_ceasing({"X", "Y"});
    expect_exact();
    for (const std::string motor : {"X", "Y"}) {
        expect_difference(ceased_later(motor), "motor " + motor + " rests at step");
    }
}

TEST_F(RecordedProbes, AreUnknownWithoutTheChangeOfTheInput) {
    record();
    test::AlteredLog log(path());
    EXPECT_EQ(log.leave_out<channel_event_t>("_CHANNELS", [](const auto& event) { return closes(event, "Y"); }), 1U);
    const Findings findings = verify_log(log.write(test::test_directory() / "altered.lcm")).value();
    EXPECT_FALSE(findings.difference) << findings.difference->text;
    EXPECT_FALSE(findings.is_exact());
}

}  // namespace
}  // namespace lockstep::verification
