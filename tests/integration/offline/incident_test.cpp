// lockstep analyze --incident reports one incident, the newest unless --back names another, and lists all.
#include <gmock/gmock.h>
#include <google/protobuf/util/json_util.h>
#include <sys/wait.h>

#include <array>
#include <cmath>
#include <cstdio>

#include "idl/proto/report.pb.h"
#include "services/flight/incident_file.hpp"
#include "tests/temporary_directory.hpp"

namespace lockstep {
namespace {

namespace fs = std::filesystem;
using testing::AllOf;
using testing::HasSubstr;
using testing::Not;

constexpr std::int64_t kSecond = 1'000'000;  // ticks

constexpr const char* kTwoAxes =
    "name: \"rig\"\n"
    "axis { name: \"X\" steps_per_mm: 80 start_velocity_mm_s: 10 max_velocity_mm_s: 100 max_accel_mm_s2: 1000\n"
    "  position_min_mm: 0 position_max_mm: 100 }\n"
    "axis { name: \"Y\" steps_per_mm: 80 start_velocity_mm_s: 10 max_velocity_mm_s: 100 max_accel_mm_s2: 1000\n"
    "  position_min_mm: 0 position_max_mm: 100 }\n";

/// The notes of a coordinator.
class AnalyzeIncident : public testing::Test {
protected:
    /// A limit was hit, the machine was reset, and an emergency stop was commanded 3 s after the limit.
    AnalyzeIncident() {
        note(10, FlightKind::Fault, 0, FaultCode::LimitHit, flight_axis(MotorIndex{1}));
        note(10, FlightKind::Incident, static_cast<std::uint8_t>(IncidentReason::Fault), {},
             flight_axis(MotorIndex{1}));
        note(10.1, FlightKind::Phase, static_cast<std::uint8_t>(MachinePhase::Fault));
        note(11, FlightKind::CommandReceived, static_cast<std::uint8_t>(CommandKind::Reset));
        note(11.1, FlightKind::Phase, static_cast<std::uint8_t>(MachinePhase::Idle));
        note(13, FlightKind::CommandReceived, static_cast<std::uint8_t>(CommandKind::TakeLease));
        note(13, FlightKind::CommandReceived, static_cast<std::uint8_t>(CommandKind::EmergencyStop));
        note(13, FlightKind::Fault, 0, FaultCode::EmergencyStopped);
        note(13, FlightKind::Incident, static_cast<std::uint8_t>(IncidentReason::Fault));
    }

    void note(double s, FlightKind kind, std::uint8_t detail, FaultCode fault = FaultCode::None,
              FlightPeer about = {}) {
        const Tick tick{std::llround(s * kSecond)};
        events_.push_back(
            {events_.size() + 1, {.tick = tick, .kind = kind, .about = about, .detail = detail, .fault = fault}});
    }
    /// Writes all notes before `end_s` into a file, as of an incident at `at_s`.
    void write(double at_s, double end_s) const {
        const FlightSource source{.machine = "rig",
                                  .process = "coordinator",
                                  .incarnation = 7,
                                  .tick_ns = 1000,
                                  .config = kTwoAxes,
                                  .directory = directory_.path(),
                                  .files = 9};
        FlightSnapshot snapshot{source, {}};
        for (const NumberedEvent& event : events_) {
            if (event.event.tick < Tick{std::llround(end_s * kSecond)}) { snapshot.events.push_back(event); }
        }
        const Tick at{std::llround(at_s * kSecond)};
        ASSERT_TRUE(write_incident(snapshot, {IncidentReason::Fault, at, 1'600'000'000 * kSecond + at.value}));
    }
    /// The output of the command, with its errors.
    std::string analyzed(const std::string& options, int exit = 0) const {
        const std::string command = std::string(LOCKSTEP_COMMAND) + " analyze --incident " +
                                    directory_.path().string() + " " + options + " 2>&1";
        FILE* pipe = popen(command.c_str(), "r");
        std::string out;
        std::array<char, 4096> part{};
        while (const std::size_t got = std::fread(part.data(), 1, part.size(), pipe)) { out.append(part.data(), got); }
        EXPECT_EQ(WEXITSTATUS(pclose(pipe)), exit) << out;
        return out;
    }
    std::vector<std::string> pages() const {
        std::vector<std::string> names;
        for (const auto& entry : fs::directory_iterator(directory_.path())) {
            if (entry.path().extension() == ".html") { names.push_back(entry.path().filename().string()); }
        }
        std::ranges::sort(names);
        return names;
    }

    TemporaryDirectory directory_;
    std::vector<NumberedEvent> events_;
};

TEST_F(AnalyzeIncident, ReportsTheNewestAndListsAll) {
    write(10, 12);
    write(13, 20);
    const std::string text = analyzed("--no-html");
    const std::string report = text.substr(0, text.find("incidents in these files"));
    EXPECT_THAT(report, AllOf(HasSubstr("an emergency stop was commanded"), Not(HasSubstr("limit-hit"))));
    const std::string list = text.substr(report.size());
    EXPECT_THAT(list, HasSubstr("--back 0   2020-09-13 12:26:53 UTC  an emergency stop was commanded"));
    EXPECT_THAT(list, HasSubstr("--back 1   2020-09-13 12:26:50 UTC  axis Y: limit-hit"));
}

TEST_F(AnalyzeIncident, ReportsTheOneThatIsAskedFor) {
    write(10, 12);
    write(13, 20);
    const std::string text = analyzed("--no-html --back 1");
    const std::string report = text.substr(0, text.find("incidents in these files"));
    EXPECT_THAT(report, AllOf(HasSubstr("axis Y: limit-hit"), Not(HasSubstr("emergency")), HasSubstr("reset")));
}

TEST_F(AnalyzeIncident, RefusesOneThatIsNotThere) {
    write(10, 12);
    write(13, 20);
    EXPECT_THAT(analyzed("--no-html --back 2", 2), HasSubstr("the files hold 2 incidents, so it goes from 0 to 1"));
}

TEST_F(AnalyzeIncident, WritesAPageForEach) {
    write(10, 12);
    write(13, 20);
    (void)analyzed("");
    (void)analyzed("--back 1");
    EXPECT_THAT(pages(), testing::ElementsAre("20200913T122650.000Z.html", "20200913T122653.000Z.html"));
}

TEST_F(AnalyzeIncident, NumbersThePagesOfIncidentsInOneFile) {
    write(10, 20);
    EXPECT_THAT(analyzed(""), HasSubstr("2020-09-13 12:26:53 UTC  an emergency stop"));
    (void)analyzed("--back 1");
    EXPECT_THAT(pages(), testing::ElementsAre("20200913T122650.000Z-2.html", "20200913T122650.000Z.html"));
}

TEST_F(AnalyzeIncident, PrintsOnceWhatIsNotedTwiceInOneLoop) {
    note(13.2, FlightKind::Fault, 0, FaultCode::EmergencyStopped);
    write(10, 20);
    const std::string once = analyzed("--no-html");
    note(13.2, FlightKind::Fault, 0, FaultCode::EmergencyStopped);
    write(10, 20);
    EXPECT_EQ(analyzed("--no-html"), once);
    EXPECT_THAT(once, HasSubstr("+0.200  coordinator  fault: emergency-stopped"));
}

TEST_F(AnalyzeIncident, NamesCommands) {
    write(10, 20);
    EXPECT_THAT(analyzed("--no-html"), HasSubstr("receives the command estop"));
    EXPECT_THAT(analyzed("--no-html --all"), HasSubstr("receives the command take-lease"));
}

TEST_F(AnalyzeIncident, AsJsonHasAllIncidents) {
    write(10, 20);
    proto::IncidentReport report;
    ASSERT_TRUE(google::protobuf::util::JsonStringToMessage(analyzed("--json --back 1"), &report).ok());
    EXPECT_EQ(report.back(), 1);
    EXPECT_EQ(report.cause(), "fault");
    ASSERT_EQ(report.incidents_size(), 2);
    EXPECT_EQ(report.incidents(0).cause(), "emergency-stop");
    EXPECT_EQ(report.incidents(1).cause(), "fault");
}

TEST_F(AnalyzeIncident, ListsTenOfManyAndTheChosenOneAmongThem) {
    for (int i = 1; i <= 12; ++i) {
        const double s = 13 + i;
        note(s + 0.1, FlightKind::Phase, static_cast<std::uint8_t>(MachinePhase::Fault));
        note(s + 0.2, FlightKind::Phase, static_cast<std::uint8_t>(MachinePhase::Idle));
        note(s + 0.9, FlightKind::Incident, static_cast<std::uint8_t>(IncidentReason::Fault));
        if (i % 4 == 0) { write(s, s + 1); }
    }
    for (const int back : {0, 5, 13}) {
        const std::string text = analyzed("--no-html --back " + std::to_string(back));
        const std::string list = text.substr(text.find("14 incidents in these files"));
        std::size_t lines = 0;
        for (std::size_t at = list.find("\n  --back"); at != list.npos; at = list.find("\n  --back", at + 1)) {
            ++lines;
        }
        EXPECT_EQ(lines, 10U) << list;
        EXPECT_THAT(list, AllOf(HasSubstr("--back " + std::to_string(back) + " "), HasSubstr("(this one)"),
                                HasSubstr("and 4 more")));
    }
}

TEST_F(AnalyzeIncident, OfOneIncidentHasNoList) {
    write(10, 12);
    EXPECT_THAT(analyzed("--no-html"), Not(HasSubstr("--back")));
}

}  // namespace
}  // namespace lockstep
