// Programs of any density run without a stop. The time of a line does not depend on how finely it is cut, and 100,000
// lines start at once.
#include <cmath>
#include <numbers>

#include "tests/unit/virtual/rig.hpp"

namespace lockstep {
namespace {

/// The times of the first and the last step, and whether a motion was interrupted.
class MotionTimes : public VirtualObserver {
public:
    void on_step(MotorIndex, StepEdge step) override {
        first = first == Tick{} ? step.tick : first;
        last = step.tick;
    }
    void on_coordinator(std::size_t, Tick, const CoordinatorOutputs& out) override {
        for (const CoordinatorNotice& notice : out.notices) {
            interruptions += notice.kind == CoordinatorNotice::Kind::Interrupted ? 1 : 0;
        }
    }
    Ticks duration() const { return last - first; }

    Tick first;
    Tick last;
    int interruptions = 0;
};

class DensePrograms : public Rig {
protected:
    MotionTimes run_to_end(const Program& program, double seconds) {
        MotionTimes times;
        vm.observe(times);
        asked = vm.now();
        EXPECT_EQ(run(program).status, ReplyStatus::Accepted);
        EXPECT_TRUE(reaches(MachinePhase::Idle, seconds)) << describe();
        EXPECT_EQ(fault(), FaultCode::None);
        EXPECT_EQ(times.interruptions, 0);
        return times;
    }
    Tick asked;
};

Program line_in_parts(int parts) {
    std::vector<std::vector<double>> targets;
    for (int k = 1; k <= parts; ++k) { targets.push_back({5 + 80.0 * k / parts, 5}); }
    return program_of(targets, 50);
}

TEST_F(DensePrograms, ALineTakesTheSameTimeHoweverFinelyItIsCut) {
    home();
    const auto whole = static_cast<double>(run_to_end(line_in_parts(1), 10).duration().value);
    const double ramps = 42 * 42 / 1000.0 / 50;  // from 8 mm/s to 50 mm/s and back: 0.8 of the start velocity
    EXPECT_NEAR(whole, (1.6 + ramps) * 1e6, 3e3) << "80 mm at 50 mm/s";
    for (const int parts : {16, 800, 8000}) {
        run_to_end(program_of({{5, 5}}, 0, {85, 5}), 10);
        EXPECT_NEAR(static_cast<double>(run_to_end(line_in_parts(parts), 10).duration().value), whole, 1e-3 * whole)
            << parts;
    }
}

/// 500 circles in chords of 0.06 mm.
TEST_F(DensePrograms, AHundredThousandLinesRunWithoutAStop) {
    constexpr int kLines = 100'000;
    std::vector<std::vector<double>> targets;
    for (int k = 1; k <= kLines; ++k) {
        const double angle = 2 * std::numbers::pi * k / 200;
        targets.push_back({5 + 2 * std::sin(angle), 7 - 2 * std::cos(angle)});
    }
    home();
    const MotionTimes times = run_to_end(program_of(targets, 40), 300);
    const double seconds = 500 * 4 * std::numbers::pi / 40;
    EXPECT_NEAR(static_cast<double>(times.duration().value) * 1e-6, seconds, 0.01 * seconds);
    EXPECT_LT((times.first - asked).value, 200'000) << "it starts within 0.2 s";
    EXPECT_EQ(counts(), (std::vector<std::int64_t>{500, 500}));
}

}  // namespace
}  // namespace lockstep
