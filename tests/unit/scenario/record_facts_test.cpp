// Facts that scenarios read from a record themselves.
#include "clients/scenario/model/record_facts.hpp"

#include <gtest/gtest.h>
#include <unistd.h>

#include <filesystem>
#include <lockstep/run_t.hpp>

#include "services/wire/lcm/lcm_channels.hpp"
#include "services/wire/lcm/lcm_log.hpp"

namespace lockstep::scenario {
namespace {

namespace fs = std::filesystem;

class Facts : public testing::Test {
protected:
    Facts() : log(LogWriter::open(path).value()) {}
    ~Facts() override { fs::remove(path); }

    void run(std::int64_t sequence, std::int64_t epoch, std::int64_t frame, bool tail = false) {
        run_t message{};
        message.machine = "mill";
        message.axis = "X";
        message.incarnation = 7;
        message.sequence = sequence;
        message.epoch = epoch;
        message.frame = frame;
        message.tail = tail ? 1 : 0;
        log.write_message(channels_of("mill", "X").run, 0, message);
    }
    RecordFacts facts() {
        EXPECT_TRUE(log.flush());
        return record_facts(path).value();
    }

    fs::path path = fs::temp_directory_path() / ("facts-" + std::to_string(getpid()) + ".lcm");
    LogWriter log;
};

TEST_F(Facts, AnEpochEndsWithItsLastRunEvenIfAnotherIsRecordedLater) {
    run(0, 3, 1);
    run(2, 3, 2, true);
    run(1, 3, 2);
    EXPECT_EQ(facts().epochs.at(3).at("X"), (EpochEnd{2, true}));
}

TEST_F(Facts, AMoveOfAnAxisOnItsOwnIsNoEpoch) {
    run(0, 0, 1);
    EXPECT_TRUE(facts().epochs.empty());
}

}  // namespace
}  // namespace lockstep::scenario
