// Boards with their own clocks work as one machine, with offsets of seconds and rates 100 ppm apart.
#include <algorithm>
#include <cmath>
#include <cstdlib>
#include <map>

#include "core/step/engine.hpp"
#include "tests/unit/virtual/rig.hpp"
#include "tests/unit/virtual/true_clocks.hpp"

namespace lockstep {
namespace {

MachineConfig network_machine(std::int64_t limit_us = 250) {
    MachineConfig machine = small_machine();
    machine.timing.time_source = TimeSource::Network;
    machine.timing.clock_error_limit_us = limit_us;
    return machine;
}

VirtualOptions own_clocks(std::int64_t limit_us = 250) {
    VirtualOptions options{.machine = network_machine(limit_us)};
    options.network = {.delay_min{20}, .delay_max{300}, .lost = 0.02};
    options.start = Tick{10'000'000};
    options.clocks = test::clocks_apart();
    return options;
}

/// The commanded motion in machine time, the devices' motion in true time, and the axes' published bounds.
class TrueTime : public VirtualObserver {
public:
    TrueTime(const VirtualOptions& options, VirtualMachine& vm) : options_(options) { vm.observe(*this); }

    void on_coordinator(std::size_t /*process*/, Tick /*now*/, const CoordinatorOutputs& out) override {
        for (const Frame& frame : out.frames) { sent_.emplace(std::pair{frame.epoch, frame.number}, frame); }
    }
    void on_step(std::size_t axis, StepEdge step) override {
        if (recording_) { made_[axis].push_back(truth_of(axis, step.tick)); }
    }
    void on_axis(std::size_t axis, Tick now, const AxisOutputs& out, AxisNode& /*node*/) override {
        for (const ExecutedTrack& track : out.tracks) { run_[axis].push_back({track.epoch, track.frame, track.tail}); }
        if (out.state) { bounds_[axis][static_cast<double>(now.value)] = out.state->clock_error.value; }
    }
    void record() { recording_ = true; }

    /// Expects every step within the last bound that its axis published before the step, plus two ticks.
    void expect_within_bounds() {
        for (std::size_t axis = 0; axis < options_.clocks.size(); ++axis) {
            const std::vector<Tick> commanded = commanded_of(axis);
            ASSERT_EQ(made_[axis].size(), commanded.size()) << "axis " << axis;
            for (std::size_t i = 0; i < commanded.size(); ++i) {
                const double off = made_[axis][i] - static_cast<double>(commanded[i].value);
                const auto bound = std::prev(bounds_[axis].upper_bound(made_[axis][i]));
                ASSERT_LE(std::abs(off), static_cast<double>(bound->second) + 2) << "axis " << axis << ", step " << i;
                worst_ = std::max(worst_, std::abs(off));
                widest_ = std::max(widest_, bound->second);
            }
        }
    }
    /// The greatest error of all compared steps, in ticks.
    double worst() const { return worst_; }
    std::int64_t widest() const { return widest_; }
    std::size_t steps() const { return made_.at(0).size(); }

private:
    double truth_of(std::size_t axis, Tick device) const {
        return options_.clocks[axis].device.truth(device, options_.start);
    }
    std::vector<Tick> commanded_of(std::size_t axis) const {
        std::vector<Tick> steps;
        for (const Run& run : run_.at(axis)) {
            const auto frame = sent_.find({run.epoch, run.frame});
            if (frame != sent_.end()) { append_steps(frame->second, frame->second.axes[axis], run.tail, steps); }
        }
        return steps;
    }

    static void append_steps(const Frame& frame, const AxisTrack& track, bool tail, std::vector<Tick>& steps) {
        StepEngine engine(frame.start, track.from);
        const auto execute = [&](const auto& pieces, bool counts) {
            for (const Piece& piece : pieces) {
                engine.begin(piece);
                engine.run(engine.now() + piece.ticks, [&](StepEdge edge) {
                    if (counts) { steps.push_back(edge.tick); }
                });
            }
        };
        execute(track.body, !tail);
        if (tail) { execute(track.tail, true); }
    }

    struct Run {
        Epoch epoch = 0;
        FrameNumber frame = 0;
        bool tail = false;
    };

    VirtualOptions options_;
    bool recording_ = false;
    std::map<std::pair<Epoch, FrameNumber>, Frame> sent_;
    std::map<std::size_t, std::vector<Run>> run_;
    std::map<std::size_t, std::vector<double>> made_;
    std::map<std::size_t, std::map<double, std::int64_t>> bounds_;
    double worst_ = 0;
    std::int64_t widest_ = 0;
};

class OwnClocks : public Rig {
protected:
    OwnClocks() : Rig(own_clocks()), truth(own_clocks(), vm) {}
    std::int64_t widest_error() const {
        std::int64_t widest = 0;
        for (const auto& state : vm.axis_states()) { widest = std::max(widest, state->clock_error.value); }
        return widest;
    }
    TrueTime truth;
};

TEST_F(OwnClocks, AnAxisReportsItsClockErrorBound) {
    ASSERT_TRUE(reaches(MachinePhase::Idle, 2));
    wait(10);
    EXPECT_GT(widest_error(), 0);
    EXPECT_LT(widest_error(), 120);
}

TEST_F(OwnClocks, AJobOfMinutesIsExactAndNothingAccumulates) {
    home();
    wait(1);
    std::vector<std::vector<double>> targets;
    for (int i = 0; i < 60; ++i) { targets.push_back(i % 2 == 0 ? std::vector{90.0, 12.25} : std::vector{7.5, 83.0}); }
    targets.push_back({5, 5});
    truth.record();
    const Reply reply = run(program_of(targets, 50));
    ASSERT_EQ(reply.status, ReplyStatus::Accepted) << reply.text;
    ASSERT_TRUE(reaches(MachinePhase::Idle, 400)) << describe();
    EXPECT_EQ(vm.state()->outcome, JobOutcome::Done);
    EXPECT_EQ(counts(), (std::vector<std::int64_t>{500, 500}));
    truth.expect_within_bounds();
    EXPECT_GT(truth.steps(), 100'000u);
    std::printf("worst error %.1f us, widest bound %lld us, %zu steps\n", truth.worst(),
                static_cast<long long>(truth.widest()), truth.steps());
}

TEST_F(OwnClocks, HoldAndResumeMeetTheSamePlaces) {
    home();
    wait(1);
    ASSERT_EQ(run(program_of({{80, 30}, {5, 5}}, 20)).status, ReplyStatus::Accepted);
    ASSERT_TRUE(reaches(MachinePhase::Running, 2));
    wait(1.5);
    ASSERT_EQ(ask(CommandKind::Hold).status, ReplyStatus::Accepted);
    ASSERT_TRUE(reaches(MachinePhase::Holding, 5)) << describe();
    ASSERT_EQ(ask(CommandKind::Resume).status, ReplyStatus::Accepted);
    ASSERT_TRUE(reaches(MachinePhase::Idle, 60)) << describe();
    EXPECT_EQ(counts(), (std::vector<std::int64_t>{500, 500}));
}

class TightLimit : public Rig {
protected:
    TightLimit() : Rig(own_clocks(1)) {}
};

TEST_F(TightLimit, NoCoordinatedMoveBeginsWithAClockErrorAboveTheLimit) {
    home();
    const Reply reply = run(program_of({{20, 20}}, 20));
    EXPECT_EQ(reply.status, ReplyStatus::Refused);
    EXPECT_EQ(reply.fault, FaultCode::ClockUncertain);
    EXPECT_NE(reply.text.find("axis X: its clock error may be"), std::string::npos) << reply.text;
    EXPECT_NE(reply.text.find("timing.clock_error_limit_us is 1)"), std::string::npos) << reply.text;
}

/// The own clock of X's process is set forward while it moves.
class SetClock : public Rig {
protected:
    static VirtualOptions options() {
        VirtualOptions options = own_clocks();
        options.clocks[0].process.step = {800};
        options.clocks[0].process.step_at = options.start + Ticks{40'000'000};
        return options;
    }
    SetClock() : Rig(options()) {}
};

TEST_F(SetClock, AProcessWhoseClockIsSetDuringAMoveGoesByItsDevicesAndTheJobIsExact) {
    home();
    ASSERT_TRUE(vm.now() < Tick{45'000'000});
    const double until = 48.5 - static_cast<double>(vm.now().value) * 1e-6;
    wait(until);
    ASSERT_EQ(run(program_of({{95, 95}, {5, 5}, {95, 95}}, 20)).status, ReplyStatus::Accepted);
    ASSERT_TRUE(reaches(MachinePhase::Idle, 60)) << describe();
    EXPECT_GT(vm.now(), Tick{51'000'000}) << "the clock was set at 50 s";
    EXPECT_EQ(vm.state()->outcome, JobOutcome::Done);
    EXPECT_EQ(counts(), (std::vector<std::int64_t>{9500, 9500}));
}

/// The network between X and the coordinator fails for all messages.
TEST_F(OwnClocks, WithoutTheCoordinatorTheBoundGrows) {
    ASSERT_TRUE(reaches(MachinePhase::Idle, 2));
    wait(10);
    const std::int64_t before = widest_error();
    vm.schedule({.kind = VirtualFault::Kind::Crash, .process = 2, .at = vm.now(), .lasts = {100'000'000}});
    wait(60);
    EXPECT_GT(widest_error(), before + 60);
}

/// An axis keeps reporting although the clock of its device stands still. After 16 slots it gives the device up.
TEST_F(OwnClocks, AxisGoesOnReportingWhileItsDeviceStandsStill) {
    home();
    wait(1);
    const Tick between_looks = vm.now() + Ticks{333};
    vm.schedule({.kind = VirtualFault::Kind::StopDevice, .process = 1, .at = between_looks, .lasts = {14'000}});
    for (int slot = 0; slot < 20; ++slot) {
        wait(0.001);
        EXPECT_LE(vm.axis_states()[0]->stamp - vm.axis_states()[1]->stamp, 4) << "slot " << slot;
    }
    EXPECT_EQ(fault(), FaultCode::None) << describe();
}

TEST_F(OwnClocks, LostDeviceIsNamedAsTheCause) {
    for (const auto kind : {VirtualFault::Kind::KillDevice, VirtualFault::Kind::StopDevice}) {
        home();
        wait(1);
        ASSERT_EQ(run(program_of({{95, 95}, {5, 5}}, 20)).status, ReplyStatus::Accepted);
        wait(1.5);
        vm.schedule({.kind = kind, .process = 1, .at = vm.now(), .lasts = {2'000'000}});
        ASSERT_TRUE(reaches(MachinePhase::Fault, 1)) << describe();
        EXPECT_EQ(fault(), FaultCode::DeviceLost) << describe();
        EXPECT_EQ(vm.state()->fault_axis, 1U);
        wait(4);
        ASSERT_EQ(ask(CommandKind::Reset).status, ReplyStatus::Accepted);
        wait(1);
    }
    home();
}

}  // namespace
}  // namespace lockstep
