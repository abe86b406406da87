// A coordinator notes each command once, and names an axis only for a fault of an axis.
#include "core/flight/coordinator_flight.hpp"

#include <gmock/gmock.h>

namespace lockstep {
namespace {

using testing::ElementsAre;

struct Notes : FlightLog {
    void add(const FlightEvent& event) override { events.push_back(event); }
    void set_note(std::string_view /*text*/) override {}
    std::vector<FlightEvent> events;
};

class CoordinatorNotes : public testing::Test {
protected:
    CoordinatorNotes() : flight_({.axes = {AxisConfig{.name = "X"}, AxisConfig{.name = "Y"}}}, notes_) {}

    void receive(Identity client, std::uint64_t sequence, CommandKind kind) {
        const std::vector<Command> commands{{.client = client, .sequence = sequence, .kind = kind}};
        flight_.take({.now = Tick{++now_}, .commands = commands}, {});
    }
    std::vector<CommandKind> commands() const {
        std::vector<CommandKind> kinds;
        for (const FlightEvent& event : notes_.events) {
            if (event.kind == FlightKind::CommandReceived) { kinds.push_back(static_cast<CommandKind>(event.detail)); }
        }
        return kinds;
    }

    Notes notes_;
    CoordinatorFlight flight_;
    std::int64_t now_ = 0;
};

TEST_F(CoordinatorNotes, HaveRepeatedCommandsOfSeveralClientsOnce) {
    for (int i = 0; i < 5; ++i) {
        receive(7, 1, CommandKind::TakeLease);
        receive(7, 2, CommandKind::Jog);
        receive(8, 1, CommandKind::TakeLease);
    }
    EXPECT_THAT(commands(), ElementsAre(CommandKind::TakeLease, CommandKind::Jog, CommandKind::TakeLease));
}

TEST_F(CoordinatorNotes, HaveEachNewCommand) {
    receive(7, 1, CommandKind::TakeLease);
    receive(7, 2, CommandKind::Hold);
    receive(7, 3, CommandKind::Hold);
    receive(7, 4, CommandKind::GiveLease);
    EXPECT_THAT(commands(),
                ElementsAre(CommandKind::TakeLease, CommandKind::Hold, CommandKind::Hold, CommandKind::GiveLease));
}

TEST_F(CoordinatorNotes, NameAnAxisOnlyForAFaultOfAnAxis) {
    CoordinatorOutputs out;
    out.notices = {{CoordinatorNotice::Kind::Fault, FaultCode::EmergencyStopped, 0},
                   {CoordinatorNotice::Kind::Fault, FaultCode::LimitHit, 1}};
    flight_.take({.now = Tick{1}}, out);
    std::vector<FlightPeer> about;
    for (const FlightEvent& event : notes_.events) {
        if (event.kind == FlightKind::Fault) { about.push_back(event.about); }
    }
    EXPECT_THAT(about, ElementsAre(FlightPeer{}, flight_axis(MotorIndex{1})));
}

}  // namespace
}  // namespace lockstep
