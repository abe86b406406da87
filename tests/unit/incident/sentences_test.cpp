// Every value that a process can note has a sentence. A value that this version does not know is named by its number.
#include "clients/incident/sentences.hpp"

#include <gmock/gmock.h>

#include <utility>

#include "core/axis/own_moves/homing.hpp"
#include "core/protocol/reception_watch.hpp"
#include "services/documents/machine_file.hpp"
#include "tests/unit/virtual/rig.hpp"

namespace lockstep::incident {
namespace {

using testing::HasSubstr;
using testing::Not;

constexpr int kValues = 256;  // of FlightEvent::detail

/// The compiler spells a value that is no enumerator as a cast.
template <auto kValue>
constexpr bool is_enumerator() {
    return !std::string_view(__PRETTY_FUNCTION__).contains("kValue = (");
}

template <typename Enum>
std::vector<bool> enumerators() {
    return []<int... kAll>(std::integer_sequence<int, kAll...>) {
        return std::vector<bool>{is_enumerator<static_cast<Enum>(kAll)>()...};
    }
    (std::make_integer_sequence<int, kValues>{});
}

/// A kind whose detail is a value of an enumeration, and which of the values exist.
struct Detailed {
    FlightKind kind;
    bool of_axis;
    std::vector<bool> exists;
};

std::vector<Detailed> detailed_kinds() {
    return {{FlightKind::CommandReceived, false, enumerators<CommandKind>()},
            {FlightKind::OrderReceived, true, enumerators<AxisCommandKind>()},
            {FlightKind::OrderSent, false, enumerators<AxisCommandKind>()},
            {FlightKind::MachinePhaseReceived, true, enumerators<MachinePhase>()},
            {FlightKind::Vetoed, true, enumerators<VetoReason>()},
            {FlightKind::JobEnded, false, enumerators<JobOutcome>()},
            {FlightKind::State, true, enumerators<AxisPhase>()},
            {FlightKind::Phase, true, enumerators<AxisPhase>()},
            {FlightKind::State, false, enumerators<MachinePhase>()},
            {FlightKind::Phase, false, enumerators<MachinePhase>()},
            {FlightKind::Incident, true, enumerators<IncidentReason>()},
            {FlightKind::Reopened, true, enumerators<ReopenReason>()}};
}

class Sentences : public testing::Test {
protected:
    Sentences() {
        incident.machine = small_machine();
        incident.motors = {"axis X", "axis Y"};
        incident.processes = {{.name = "coordinator", .who = kFlightCoordinator},
                              {.name = "axis X", .who = flight_axis(MotorIndex{0})}};
    }
    std::string text(const FlightEvent& event, bool of_axis) const {
        return sentence(incident, {Tick{}, of_axis ? 1U : 0U, event});
    }

    Incident incident;
};

TEST_F(Sentences, NameEveryValueThatExistsAndNumberAllOthers) {
    for (const Detailed& detailed : detailed_kinds()) {
        for (int value = 0; value < kValues; ++value) {
            const FlightEvent event{
                .kind = detailed.kind, .about = flight_axis(MotorIndex{1}), .detail = static_cast<std::uint8_t>(value)};
            const std::string said = text(event, detailed.of_axis);
            EXPECT_THAT(said, Not(HasSubstr("unknown"))) << name_of(detailed.kind) << " " << value;
            EXPECT_THAT(said, Not(testing::MatchesRegex("(.*[ :])?"))) << name_of(detailed.kind) << " " << value;
            const bool is_numbered = said.contains("number " + std::to_string(value) + " (not of this version)");
            EXPECT_EQ(is_numbered, !detailed.exists[static_cast<std::size_t>(value)]) << said;
        }
    }
}

TEST_F(Sentences, OfEveryKindHaveNoUnknownPart) {
    for (int kind = 0; kind < kValues; ++kind) {
        if (!enumerators<FlightKind>()[static_cast<std::size_t>(kind)]) { continue; }
        for (const FlightPeer about :
             {FlightPeer{}, flight_axis(MotorIndex{1}), flight_axis(MotorIndex{kMaxAxes - 1}), kFlightCoordinator}) {
            const FlightEvent event{
                .kind = static_cast<FlightKind>(kind), .about = about, .fault = FaultCode::LimitHit};
            for (const bool of_axis : {false, true}) {
                const std::string said = text(event, of_axis);
                EXPECT_FALSE(said.empty()) << name_of(event.kind);
                EXPECT_THAT(said, Not(HasSubstr("unknown"))) << name_of(event.kind);
            }
        }
    }
}

TEST_F(Sentences, NameEveryFaultAndNumberAllOthers) {
    for (const FlightKind kind : {FlightKind::PeerFault, FlightKind::FrameRefused, FlightKind::Fault,
                                  FlightKind::CommandRefused, FlightKind::PositionClaimed}) {
        for (int code = 1; code < 1000; ++code) {
            const FlightEvent event{
                .kind = kind, .about = flight_axis(MotorIndex{1}), .fault = static_cast<FaultCode>(code)};
            const FaultText* fault = find_fault(event.fault);
            const std::string part = fault == nullptr ? "number " + std::to_string(code) : std::string(fault->name);
            EXPECT_THAT(text(event, true), HasSubstr(part));
        }
    }
}

TEST_F(Sentences, NameEveryStageOfHomingAndNumberAllOthers) {
    const std::vector<bool> exists = enumerators<HomingStage>();
    for (std::int64_t stage = -1; stage < kValues; ++stage) {
        const std::string said = text({.kind = FlightKind::HomingStage, .count = stage}, true);
        const bool is_known = stage >= 0 && exists[static_cast<std::size_t>(stage)];
        EXPECT_EQ(said.contains("number " + std::to_string(stage)), !is_known) << said;
        EXPECT_THAT(said, Not(HasSubstr("unknown")));
    }
}

TEST_F(Sentences, NameNoAxisForAFaultOfTheWholeMachine) {
    const FlightEvent event{
        .kind = FlightKind::Fault, .about = flight_axis(MotorIndex{0}), .fault = FaultCode::EmergencyStopped};
    EXPECT_THAT(text(event, false), testing::StartsWith("fault: emergency-stopped"));
}

}  // namespace
}  // namespace lockstep::incident
