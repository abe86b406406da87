// A process that ends with a failed check leaves an incident file that names the check.
#include "services/flight/check_report.hpp"

#include <gmock/gmock.h>
#include <sys/wait.h>
#include <unistd.h>

#include "services/flight/flight_recorder.hpp"
#include "services/flight/incident_file.hpp"
#include "services/wire/lcm/lcm_decode.hpp"
#include "services/wire/lcm/lcm_log.hpp"
#include "tests/unit/flight/flight_makers.hpp"

namespace lockstep {
namespace {

class FailedCheck : public FlightFolder {
protected:
    /// In a child process: records one event, then fails a check. The next process saves its record.
    void fail_a_check(const std::string& promise) {
        const pid_t child = fork();
        if (child == 0) {
            const auto recorder = FlightRecorder::open(rings(), source(), 10).value();
            const CheckReport report(*recorder);
            recorder->add(noted(42));
            check(false, promise);
            _exit(0);
        }
        int status = 0;
        waitpid(child, &status, 0);
        ASSERT_TRUE(WIFSIGNALED(status));
        ASSERT_EQ(WTERMSIG(status), SIGABRT);
        FlightRecorder::open(rings(), source(), 10).value().reset();
    }
    std::vector<flight_note_t> notes() const {
        std::vector<flight_note_t> found;
        auto log = LogReader::open(incident_files(folder / "incidents").at(0)).value();
        while (const auto event = log.next().value()) {
            if (auto note = decode_lcm<flight_note_t>(event->data)) { found.push_back(*std::move(note)); }
        }
        return found;
    }
};

TEST_F(FailedCheck, IsNamedInTheIncidentFile) {
    fail_a_check("one exceeds two");
    ASSERT_EQ(notes().size(), 1U);
    EXPECT_THAT(notes()[0].text,
                testing::MatchesRegex("failed check: one exceeds two \\(.*check_report_test.cpp:.*\\)"));
    EXPECT_EQ(notes()[0].process, "axis-X");
    EXPECT_EQ(notes()[0].incarnation, 7);
}

TEST_F(FailedCheck, IsCutToItsPlaceInTheRing) {
    fail_a_check(std::string(1000, 'x'));
    ASSERT_EQ(notes().size(), 1U);
    EXPECT_EQ(notes()[0].text.size(), kFlightNoteBytes - 1);
}

TEST_F(FailedCheck, LeavesNoNoteInAProcessThatIsKilled) {
    const pid_t child = fork();
    if (child == 0) {
        const auto recorder = FlightRecorder::open(rings(), source(), 10).value();
        const CheckReport report(*recorder);
        raise(SIGKILL);
    }
    waitpid(child, nullptr, 0);
    FlightRecorder::open(rings(), source(), 10).value().reset();
    EXPECT_TRUE(notes().empty());
}

}  // namespace
}  // namespace lockstep
