// A stop or a hold ends homing in any of its stages soon, within the limits and at rest. Homing can then begin again.
#include <set>

#include "core/axis/own_moves/homing.hpp"
#include "core/methods/suits.hpp"
#include "core/motion/limit_watch.hpp"
#include "core/motion/step_source.hpp"
#include "tests/unit/virtual/rig.hpp"

namespace lockstep {
namespace {

/// Keeps for each axis the stage of its homing, all its steps, and the beginning of its newest run.
class HomingLog : public VirtualObserver {
public:
    void on_step(MotorIndex axis, StepEdge step) override { axes[axis].steps.push_back(step.tick); }
    void on_axis(MotorIndex axis, Tick /*now*/, const AxisOutputs& out, AxisNode& /*node*/) override {
        for (const AxisNotice& notice : out.notices) {
            if (notice.kind == AxisNotice::Kind::HomingStage) {
                axes[axis].stage = static_cast<HomingStage>(notice.number);
            }
        }
        for (const ExecutedTrack& track : out.tracks) {
            if (track.frame == 1 && !track.tail) { axes[axis].run_begins = track.start; }
        }
    }
    struct Axis {
        HomingStage stage = HomingStage::Idle;
        Tick run_begins;
        std::vector<Tick> steps;
    };
    std::vector<Axis> axes{2};
};

MachineConfig machine_that_homes_by(StepMethod method) {
    MachineConfig machine = small_machine();
    for (AxisConfig& axis : machine.axes) {
        axis.method = method;
        if (method == StepMethod::Lai) { axis.max_velocity_mm_s = 40; }
        if (method == StepMethod::Lam) { axis.max_velocity_mm_s = 16.66; }
    }
    machine.axes[0].plant.start_position_mm = 1;
    machine.axes[1].plant.start_position_mm = -1.5;  // on its switch: homing first releases the switch
    return machine;
}

/// Begins homing, ends it some time later, and homes again.
class EndedHoming : public Rig {
public:
    explicit EndedHoming(StepMethod method) : Rig({.machine = MachineSetup{machine_that_homes_by(method)}}) {
        vm.observe(log_);
    }

    /// Returns false if homing was done before that.
    bool ends_after(std::int64_t ms, CommandKind how) {
        EXPECT_TRUE(reaches(MachinePhase::Idle, 2));
        EXPECT_EQ(ask(CommandKind::Home).status, ReplyStatus::Accepted);
        EXPECT_TRUE(reaches(MachinePhase::Homing, 0.1));
        wait(static_cast<double>(ms) * 1e-3);
        if (vm.state()->phase != MachinePhase::Homing) { return false; }
        for (const auto& axis : log_.axes) { steps_at_order_.push_back(axis.steps.size()); }
        const Reply reply = ask(how);
        EXPECT_EQ(reply.status, ReplyStatus::Accepted) << reply.text;
        EXPECT_TRUE(reaches(MachinePhase::Idle, 0.2)) << describe();
        return true;
    }
    void expect_rest_where_it_was() {
        EXPECT_EQ(vm.state()->outcome, JobOutcome::Stopped);
        for (std::size_t i = 0; i < 2; ++i) {
            const AxisState& state = *vm.axis_states()[i];
            EXPECT_TRUE(state.at_rest);
            EXPECT_EQ(state.fault, FaultCode::None);
            EXPECT_EQ(state.following_error_steps, 0) << "no step is lost";
            EXPECT_EQ(state.homing, HomingStage::Idle);
            const bool has_zero = stage(i) == HomingStage::Park || stage(i) == HomingStage::Idle;
            EXPECT_EQ(state.homed, has_zero && is_within_travel(i))
                << "once its zero is set, and it has left its switch";
            EXPECT_EQ(state.phase, state.homed ? AxisPhase::Standby : AxisPhase::Initialize);
            EXPECT_LE(log_.axes[i].steps.size() - steps_at_order_[i], most_steps_to_rest(i)) << "axis " << i;
            expect_newest_run_within_limits(i);
        }
        const auto steps = log_.axes[0].steps.size() + log_.axes[1].steps.size();
        wait(0.3);
        EXPECT_EQ(log_.axes[0].steps.size() + log_.axes[1].steps.size(), steps);
    }
    void expect_homing_works() {
        EXPECT_EQ(ask(CommandKind::Home).status, ReplyStatus::Accepted);
        EXPECT_TRUE(reaches(MachinePhase::Idle, 20)) << describe();
        EXPECT_EQ(vm.state()->outcome, JobOutcome::Done);
        EXPECT_EQ(counts(), (std::vector<std::int64_t>{500, 500}));
        for (std::size_t i = 0; i < 2; ++i) { EXPECT_NEAR(vm.device(i).plant().position_mm(), 5, 0.011); }
    }
    HomingStage stage(std::size_t axis) const { return log_.axes[axis].stage; }

private:
    void TestBody() override {}

    bool is_within_travel(std::size_t i) const {
        const AxisConfig& axis = vm.machine().axes[i];
        return vm.device(i).plant().position_mm() >= axis.position_min_mm - 0.6 / axis.steps_per_mm;
    }

    /// The order takes four slots at most, and the frame in progress 10 ms. A step in progress may last longer.
    std::size_t most_steps_to_rest(std::size_t i) const {
        const AxisConfig& axis = vm.machine().axes[i];
        const double speed = stage(i) == HomingStage::Park ? axis.max_velocity_mm_s : axis.homing.search_velocity_mm_s;
        const double until_it_brakes_s = 4e-6 * static_cast<double>(vm.machine().timing.slot_us) + 0.01;
        const double braking_mm = speed * speed / (2 * axis.max_decel_mm_s2);
        return static_cast<std::size_t>(to_steps(axis, speed * until_it_brakes_s + braking_mm) + 2);
    }
    void expect_newest_run_within_limits(std::size_t i) const {
        const auto limits = methods::speed_limits_of(vm.machine().axes[i], vm.machine().tick_ns);
        const double rounding = 1.1 * limits.max * limits.max * limits.tick_s;
        LimitWatch watch({limits.start + rounding, limits.acceleration, limits.deceleration});
        Tick before = log_.axes[i].run_begins;
        bool is_first = true;
        for (const Tick step : log_.axes[i].steps) {
            if (step <= log_.axes[i].run_begins) { continue; }
            const Ticks wait = (step - before) * std::int64_t{is_first ? 2 : 1};  // the first wait is for half a step
            EXPECT_FALSE(watch.step(static_cast<double>(wait.value) * 1e-6)) << "axis " << i;
            before = step;
            is_first = false;
        }
        const auto at_rest = watch.rest();
        EXPECT_FALSE(at_rest) << "axis " << i << ": the speed falls by " << at_rest->change << " steps/s, not by "
                              << at_rest->allowed;
    }

    HomingLog log_;
    std::vector<std::size_t> steps_at_order_;
};

class HomingStops : public testing::TestWithParam<StepMethod> {};

TEST_P(HomingStops, EndItSoonInEveryStageAndItWorksAgain) {
    std::set<HomingStage> stages;
    bool is_homing = true;
    for (std::int64_t ms = 0; is_homing && !HasFailure(); ms += 23) {
        SCOPED_TRACE(std::to_string(ms) + " ms after it was asked for");
        EndedHoming rig(GetParam());
        is_homing = rig.ends_after(ms, ms % 2 == 0 ? CommandKind::Stop : CommandKind::Hold);
        if (!is_homing) { break; }
        stages.insert({rig.stage(0), rig.stage(1)});
        rig.expect_rest_where_it_was();
        rig.expect_homing_works();
    }
    for (const HomingStage stage :
         {HomingStage::Search, HomingStage::Release, HomingStage::PullOff, HomingStage::Latch, HomingStage::Park}) {
        EXPECT_TRUE(stages.contains(stage)) << "never ended in stage " << static_cast<int>(stage);
    }
}

INSTANTIATE_TEST_SUITE_P(All, HomingStops,
                         testing::Values(StepMethod::Ranade, StepMethod::Spielauer, StepMethod::Lai, StepMethod::Lam,
                                         StepMethod::Carrica),
                         [](const auto& method) { return std::string(name_of(method.param)); });

class HomingRig : public Rig {
protected:
    explicit HomingRig(MachineConfig machine = small_machine()) : Rig({.machine = MachineSetup{std::move(machine)}}) {}

    void begin_homing() {
        ASSERT_TRUE(reaches(MachinePhase::Idle, 2));
        ASSERT_EQ(ask(CommandKind::Home).status, ReplyStatus::Accepted);
        wait(0.3);
        ASSERT_EQ(vm.state()->phase, MachinePhase::Homing);
    }
};

TEST_F(HomingRig, AnAxisThatFailsToHomeStopsTheOthersBeforeTheFault) {
    begin_homing();
    vm.schedule({.kind = VirtualFault::Kind::Crash, .process = 0, .at = vm.now(), .lasts = {5'000'000}});
    ASSERT_TRUE(reaches(MachinePhase::Fault, 2)) << describe();
    EXPECT_EQ(fault(), FaultCode::AxisLost);
    EXPECT_TRUE(vm.axis_states()[1]->at_rest) << "Fault is published at rest";
    EXPECT_FALSE(vm.axis_states()[1]->homed);
}

class HomingInTurn : public HomingRig {
protected:
    HomingInTurn()
        : HomingRig([] {
              MachineConfig machine = small_machine();
              machine.axes[1].homing.sequence = 1;
              return machine;
          }()) {}
};

TEST_F(HomingInTurn, AxesWhoseTurnHasNotComeStayAsTheyAre) {
    home();
    begin_homing();
    ASSERT_EQ(ask(CommandKind::Stop).status, ReplyStatus::Accepted);
    ASSERT_TRUE(reaches(MachinePhase::Idle, 1)) << describe();
    EXPECT_FALSE(vm.axis_states()[0]->homed);
    EXPECT_TRUE(vm.axis_states()[1]->homed);
    EXPECT_EQ(run(program_of({{10, 10}}, 0)).fault, FaultCode::NotHomed);
}

}  // namespace
}  // namespace lockstep
