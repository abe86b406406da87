// Real processes are stopped, killed and hang: each writes its notes, and `lockstep analyze --incident` names the
// one that caused the incident.
#include <gmock/gmock.h>
#include <signal.h>

#include <set>
#include <thread>

#include "tests/integration/cli/own_machine.hpp"
#include "tests/integration/wire/eventually.hpp"

namespace lockstep {
namespace {

namespace fs = std::filesystem;
using namespace std::chrono_literals;
using testing::HasSubstr;

class Flight : public OwnMachine {
protected:
    fs::path directory() const { return state().path() / "record" / "incidents"; }
    /// The processes with an incident file.
    std::set<std::string> writers() const {
        std::set<std::string> found;
        std::error_code error;
        for (const auto& entry : fs::directory_iterator(directory(), error)) {
            const std::string name = entry.path().filename().string();
            if (!name.ends_with(".flight.lcm")) { continue; }
            const std::size_t from = name.find('-') + 1;
            found.insert(name.substr(from, name.rfind('-') - from));
        }
        return found;
    }
    bool all_write() const {
        return eventually([&] { return writers() == std::set<std::string>{"axis-X", "axis-Y", "coordinator"}; });
    }
    proto::IncidentReport incident(const std::string& back = "0") const {
        const Ran ran = run_lockstep({"analyze", "--incident", directory().string(), "--back", back, "--json"});
        EXPECT_EQ(ran.code, 0) << ran.err;
        return ran.json<proto::IncidentReport>();
    }
    void begin_job() {
        bring_up_and_home();
        run_job();
    }
    void run_job() {
        job_.emplace(LOCKSTEP_COMMAND, Words{"run", write("job.gcode", "G21 G90\nG1 X150 Y30 F1200\nM2\n"), "--json"});
        ASSERT_TRUE(eventually([&] {
            const proto::StatusReport now = status();
            return now.axes_size() == 2 && now.axes(0).velocity_mm_s() > 1 && now.axes(1).velocity_mm_s() > 1;
        }));
    }
    static void expect(const proto::IncidentReport& report, const std::string& cause, const std::string& culprit) {
        EXPECT_EQ(report.cause(), cause) << report.ShortDebugString().substr(0, 2000);
        EXPECT_EQ(report.culprit(), culprit);
        EXPECT_TRUE(report.has_rest_s()) << "all came to rest";
    }

    std::optional<ChildProcess> job_;
};

TEST_F(Flight, AnAxisThatWasStoppedIsNamed) {
    begin_job();
    const pid_t axis = process("axis-Y");
    kill(axis, SIGSTOP);
    std::this_thread::sleep_for(800ms);  // 200 ms are allowed
    kill(axis, SIGCONT);
    ASSERT_TRUE(all_write());
    const auto report = incident();
    expect(report, "process-stalled", "axis Y");
    EXPECT_GT(report.cause_lasts_s(), 0.6);
    EXPECT_EQ(report.notes_size(), 0) << report.notes(0);
    EXPECT_EQ(status().incidents().directory(), directory().string());
    EXPECT_GE(status().incidents().files(), 3);
}

TEST_F(Flight, AnAxisThatWasKilledIsNamed) {
    begin_job();
    kill(process("axis-Y"), SIGKILL);
    ASSERT_TRUE(all_write());
    expect(incident(), "process-ended", "axis Y");
}

TEST_F(Flight, ACoordinatorThatWasKilledIsNamed) {
    begin_job();
    kill(process("coordinator"), SIGKILL);
    ASSERT_TRUE(all_write());
    expect(incident(), "process-ended", "the coordinator");
}

TEST_F(Flight, AnEmergencyStopIsNamed) {
    begin_job();
    EXPECT_EQ(run_lockstep({"estop"}).code, 0);
    ASSERT_TRUE(all_write());
    const auto report = incident();
    EXPECT_EQ(report.cause(), "emergency-stop");
    EXPECT_EQ(report.moving_size(), 2) << report.ShortDebugString().substr(0, 2000);
    EXPECT_TRUE(report.has_rest_s());
}

TEST_F(Flight, AnEmergencyStopAtRestAndOneInMotionAreTwoIncidents) {
    bring_up_and_home();
    EXPECT_EQ(run_lockstep({"estop"}).code, 0);
    EXPECT_EQ(run_lockstep({"reset"}).code, 0);
    ASSERT_TRUE(becomes("Idle"));
    run_job();
    EXPECT_EQ(run_lockstep({"estop"}).code, 0);
    ASSERT_TRUE(all_write());
    const auto is_whole = [](const proto::IncidentReport& report) {
        return report.incidents_size() == 2 && report.moving_size() == 2 && report.has_rest_s();
    };
    ASSERT_TRUE(eventually([&] { return is_whole(incident()); })) << "each process writes its file in its own time";
    const auto first = incident("1");
    EXPECT_EQ(first.cause(), "emergency-stop");
    EXPECT_EQ(first.moving_size(), 0);
    EXPECT_FALSE(first.has_rest_s());
    EXPECT_THAT(first.ShortDebugString(), testing::Not(HasSubstr("command unknown")));
}

TEST_F(Flight, IsReadOnRequestEvenFromAProcessThatHangs) {
    bring_up_and_home();
    const pid_t axis = process("axis-Y");
    kill(axis, SIGSTOP);
    ASSERT_TRUE(becomes("Waiting"));
    const Ran asked = run_lockstep({"flight"});
    EXPECT_EQ(asked.code, 0) << asked.err;
    EXPECT_THAT(asked.out, HasSubstr("analyze --incident " + directory().string()));
    const auto report = incident();
    EXPECT_EQ(report.cause(), "process-hangs") << report.ShortDebugString().substr(0, 2000);
    EXPECT_EQ(report.culprit(), "axis Y");
    kill(axis, SIGCONT);
}

TEST_F(Flight, BySignalEachProcessWritesItsOwn) {
    bring_up();
    kill(process("axis-X"), SIGUSR1);
    EXPECT_TRUE(eventually([&] { return writers() == std::set<std::string>{"axis-X"}; }));
    const auto report = incident();
    EXPECT_EQ(report.cause(), "asked");
    EXPECT_THAT(report.notes(0), HasSubstr("no file of: coordinator, axis Y"));
}

TEST_F(Flight, AFileThatIsNoIncidentIsRefusedWithItsPlaceAndRemedy) {
    const auto refused = [](const Words& words) {
        const Ran ran = run_lockstep(words);
        EXPECT_EQ(ran.code, 2) << ran.out;
        return ran.err;
    };
    const std::string foreign = write("foreign.flight.lcm", "no log at all");
    EXPECT_THAT(refused({"analyze", "--incident", foreign}), HasSubstr(foreign + ": contains no notes"));
    EXPECT_THAT(refused({"analyze", "--incident", foreign + ".gone"}), HasSubstr(foreign + ".gone"));
    EXPECT_THAT(refused({"analyze", "--incident", testing::TempDir() + "/nowhere"}), HasSubstr("nowhere"));
    EXPECT_THAT(refused({"analyze", foreign, foreign}), HasSubstr("name only one log"));
    EXPECT_EQ(run_lockstep({"flight"}).code, 3) << "the machine is not up";
}

}  // namespace
}  // namespace lockstep
