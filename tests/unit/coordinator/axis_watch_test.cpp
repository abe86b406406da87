// What an axis reports, or its silence, makes the job fail.
#include "core/coordinator/axis_watch.hpp"

#include "coordinator_parts.hpp"

namespace lockstep {
namespace {

class Watched : public CoordinatorParts {
protected:
    Watched() {
        receive_all();
        enter_idle(jobs);
    }
    void look() {
        CoordinatorLoop l = loop();
        watch.look(axes, jobs, l);
    }
    FaultCode fault() const { return jobs.activity().fault().code; }

    JobLifecycle jobs{machine};
    AxisWatch watch{1};
};

TEST_F(Watched, AxesThatReportNothingSpecialChangeNothing) {
    look();
    EXPECT_EQ(jobs.activity().phase(), MachinePhase::Idle);
    EXPECT_TRUE(out.notices.empty());
}

TEST_F(Watched, TheMachineWaitsForAnAxisThatFallsSilent) {
    slot += 1000;
    axes.take(state_of(1), slot);
    look();
    EXPECT_EQ(jobs.activity().phase(), MachinePhase::Waiting);
    EXPECT_FALSE(axes.state(MotorIndex{0}));
    EXPECT_TRUE(axes.state(MotorIndex{1}));
}

TEST_F(Watched, AnAxisWithAnotherConfigurationIsAFault) {
    AxisState other = state_of(0);
    other.config_hash = 2;
    axes.take(other, slot);
    look();
    EXPECT_EQ(fault(), FaultCode::ConfigMismatch);
}

TEST_F(Watched, AnAxisInFaultIsAFaultUntilItsResetIsOrdered) {
    AxisState state = state_of(1);
    state.fault = FaultCode::LimitHit;
    axes.take(state, slot);
    (void)orders.give(MotorIndex{1}, AxisCommandKind::Reset, term);
    look();
    EXPECT_EQ(fault(), FaultCode::None);
    orders.withdraw_all();
    look();
    EXPECT_EQ(fault(), FaultCode::LimitHit);
}

}  // namespace
}  // namespace lockstep
