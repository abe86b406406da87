// A coordinator that was stopped publishes its decisions late: after another has taken over and begun its own
// job.
#include <gmock/gmock.h>
#include <gtest/gtest.h>
#include <unistd.h>

#include "clients/verification/verification.hpp"
#include "tests/unit/verification/altered_log.hpp"
#include "tests/unit/verification/recorded_machine.hpp"

namespace lockstep::verification {
namespace {

using test::AlteredLog;
using testing::HasSubstr;

class LateRecord : public testing::Test {
protected:
    static constexpr std::int64_t kHeir = 77;

    static void SetUpTestSuite() {
        original = std::filesystem::path(testing::TempDir()) / ("lockstep_late_" + std::to_string(getpid()) + ".lcm");
        test::RecordedMachine recorded(test::example("two-axis"), original);
        recorded.home();
        for (const char* program : {"G21 G90 F3000\nG1 X20 Y8\nX5 Y5\n", "G21 G90 F3000\nG1 X30 Y9\n"}) {
            recorded.begin(test::program_of(recorded.vm().machine(), program));
            ASSERT_TRUE(recorded.reaches(MachinePhase::Idle));
        }
    }
    static void TearDownTestSuite() { std::filesystem::remove(original); }

    /// Gives the last job to another coordinator, and removes the end of the job before it.
    void SetUp() override {
        log.change<job_t>("_JOB", [&](job_t& job) {
            last = std::max(last, job.job);
            return false;
        });
        log.leave_out<job_t>("_JOB", [&](const job_t& job) { return job.job == last - 1 && job.event == "ended"; });
        log.change<job_t>("_JOB", [&](job_t& job) { return job.job == last && (job.coordinator = kHeir); });
    }
    bool is_word(const AlteredLog::Event& event, std::int64_t job, std::string_view what) const {
        if (!event.channel.ends_with("_JOB")) { return false; }
        const auto message = decode_lcm<job_t>(event.data).value();
        return message.job == job && message.event == what;
    }
    auto word(std::int64_t job, std::string_view what) {
        return std::ranges::find_if(log.events(), [&](const auto& event) { return is_word(event, job, what); });
    }
    Findings verified() { return verify_log(log.write(test::test_directory() / "late.lcm")).value(); }

    static inline std::filesystem::path original;
    AlteredLog log{original};
    std::int64_t last = 0;
};

TEST_F(LateRecord, LateEpochIsComparedWithItsOwnJob) {
    std::rotate(word(last - 1, "epoch"), word(last - 1, "epoch") + 1, word(last, "begun") + 1);
    const Findings found = verified();
    EXPECT_FALSE(found.difference) << to_text(found);
}

TEST_F(LateRecord, AnEpochThatNoAxisRanIsNoted) {
    AlteredLog::Event late = *word(last - 1, "epoch");
    auto message = decode_lcm<job_t>(late.data).value();
    message.epoch += 1000;
    ++message.sequence;
    message.encode(late.data.data(), 0, static_cast<int>(late.data.size()));
    log.events().insert(word(last, "ended"), late);
    const Findings found = verified();
    EXPECT_FALSE(found.difference) << to_text(found);
    EXPECT_THAT(to_text(found), HasSubstr("its coordinator records more of it after another began"));
}

TEST_F(LateRecord, AnEpochOfTheSameCoordinatorIsNotLateButWrong) {
    log.change<job_t>("_JOB", [&](job_t& job) { return job.job < last && (job.coordinator = kHeir); });
    AlteredLog::Event late = *word(last - 1, "epoch");
    auto message = decode_lcm<job_t>(late.data).value();
    message.sequence = decode_lcm<job_t>(word(last, "ended")->data).value().sequence;
    message.encode(late.data.data(), 0, static_cast<int>(late.data.size()));
    log.events().insert(word(last, "ended"), late);
    log.change<job_t>("_JOB", [](job_t& job) { return job.event == "ended" && ++job.sequence > 0; });
    EXPECT_TRUE(verified().difference);
}

}  // namespace
}  // namespace lockstep::verification
