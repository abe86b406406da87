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

    /// A touch, and a move that misses.
    static void record() {
        MachineConfig machine = test::example("two-axis");
        machine.inputs = {
            {.name = "probe", .motor = "Y", .channel = 3, .use = InputUse::Probe, .number = 0, .max_overshoot_mm = 20}};
        test::RecordedMachine recorded(machine, path());
        recorded.home();
        std::vector<double> at = parked_mm(machine);
        recorded.begin(probe({at[0] + 40, at[1] + 20}, at, true));
        recorded.advance_ms(1500);
        recorded.vm().set_input(0, true);
        ASSERT_TRUE(recorded.reaches(MachinePhase::Idle));
        ASSERT_TRUE(recorded.vm().state()->probe && recorded.vm().state()->probe->touched);
        recorded.vm().set_input(0, false);
        recorded.advance_ms(100);
        for (std::size_t i = 0; i < at.size(); ++i) {
            at[i] =
                static_cast<double>(recorded.vm().axis_states()[i]->position.count()) / machine.axes[i].steps_per_mm;
        }
        recorded.begin(probe({at[0] + 1, at[1]}, at, false));
        ASSERT_TRUE(recorded.reaches(MachinePhase::Idle));
        ASSERT_FALSE(recorded.vm().state()->probe->touched);
    }
    static Program probe(std::vector<double> to, std::vector<double> from, bool must) {
        Program program{.name = "probe.gcode", .axes = {"X", "Y"}, .start_mm = std::move(from), .blocks = {}};
        program.blocks.push_back({1, Probe{.must_touch = must}});
        program.blocks.push_back({1, ProgramMove{.target_mm = std::move(to), .feed_mm_s = 10}});
        return program;
    }
    static Findings altered(const std::function<void(job_t&)>& change) {
        test::AlteredLog log(path());
        EXPECT_EQ(log.change<job_t>("_JOB",
                                    [&](job_t& job) {
                                        const bool is_touch = job.event == "probe" && job.outcome == "touched";
                                        if (is_touch) { change(job); }
                                        return is_touch;
                                    }),
                  1);
        return verify_log(log.write(test::test_directory() / "altered.lcm")).value();
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

}  // namespace
}  // namespace lockstep::verification
