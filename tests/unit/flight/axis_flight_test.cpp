// An axis notes an incident for a motion that ends early, unless someone asked for it or a probe touched.
#include "core/flight/axis_flight.hpp"

#include <gtest/gtest.h>

#include <vector>

namespace lockstep {
namespace {

constexpr Epoch kEpoch = 7;

struct IncidentCount : FlightLog {
    void add(const FlightEvent& event) override { count += event.kind == FlightKind::Incident ? 1 : 0; }
    void set_note(std::string_view /*text*/) override {}
    int count = 0;
};

class AxisNotes : public testing::Test {
protected:
    AxisNotes() : flight_(MotorIndex{0}, {.axes = {AxisConfig{.name = "X"}, AxisConfig{.name = "Y"}}}, incidents_) {
        const std::vector<MachineState> running{{.phase = MachinePhase::Running, .epoch = kEpoch}};
        flight_.take({.now = Tick{++now_}, .coordinator = running}, {});
        notice(AxisNotice::Kind::EpochBegun, kEpoch);
    }
    void notice(AxisNotice::Kind kind, std::uint64_t number) {
        AxisOutputs out;
        out.notices = {{kind, FaultCode::None, number, {}}};
        flight_.take({.now = Tick{++now_}}, out);
    }
    void receive_touch(Epoch epoch) {
        const std::vector<AxisState> peers{{.axis = 1, .epoch = epoch, .touch = EpochTouch{epoch, Tick{now_}}}};
        flight_.take({.now = Tick{++now_}, .peers = peers}, {});
    }

    IncidentCount incidents_;
    AxisFlight flight_;
    std::int64_t now_ = 0;
};

TEST_F(AxisNotes, HaveAnIncidentForAMotionThatEndsEarly) {
    notice(AxisNotice::Kind::EpochEnded, kEpoch);
    EXPECT_EQ(incidents_.count, 1);
}

TEST_F(AxisNotes, HaveNoneForItsOwnTouch) {
    notice(AxisNotice::Kind::Touched, 100);
    notice(AxisNotice::Kind::EpochEnded, kEpoch);
    EXPECT_EQ(incidents_.count, 0);
}

TEST_F(AxisNotes, HaveNoneForTheTouchOfAnother) {
    receive_touch(kEpoch);
    notice(AxisNotice::Kind::EpochEnded, kEpoch);
    EXPECT_EQ(incidents_.count, 0);
}

TEST_F(AxisNotes, HaveOneAfterATouchOfAnEarlierEpoch) {
    receive_touch(kEpoch - 1);
    notice(AxisNotice::Kind::EpochEnded, kEpoch);
    EXPECT_EQ(incidents_.count, 1);
}

}  // namespace
}  // namespace lockstep
