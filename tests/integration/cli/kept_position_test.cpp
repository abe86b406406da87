// Positions outlive an axis's process if its device does: here lockstep-fpga, behind shared memory.
#include <gmock/gmock.h>
#include <google/protobuf/text_format.h>
#include <signal.h>

#include "idl/proto/position.pb.h"
#include "services/files/directories.hpp"
#include "services/files/text_file.hpp"
#include "tests/integration/cli/own_machine.hpp"
#include "tests/integration/wire/eventually.hpp"

namespace lockstep {
namespace {

using testing::HasSubstr;

constexpr const char* kShortJob = "G21 G90\nG1 X60 Y20 F3000\nG1 X20 Y0\nM2\n";

class KeptPositions : public OwnMachine {
protected:
    void SetUp() override {
        OwnMachine::SetUp();
        bring_up({"--fpga", "shm"});
        record();
        const Ran home = run_lockstep({"home"});
        ASSERT_EQ(home.code, 0) << home.out << home.err;
    }
    proto::AxisStatus y() const { return status().axes(1); }
    /// The position of Y on disk becomes the position of Y.
    bool y_is_kept() const {
        return eventually([&] {
            proto::KeptPosition kept;
            const auto text = read_text_file(file_of_y());
            const bool is_read = text && google::protobuf::TextFormat::ParseFromString(*text, &kept);
            return is_read && kept.count() - kept.zero_count() == y().position_steps();
        });
    }
    std::filesystem::path file_of_y() const { return position_directory(status().machine()) / "Y.textproto"; }
    /// Kills the process of Y, and waits until another process has replaced it and is present.
    void kill_y() const {
        const pid_t before = process("axis-Y");
        kill(before, SIGKILL);
        ASSERT_TRUE(eventually([&] { return process("axis-Y") != 0 && process("axis-Y") != before; }));
        ASSERT_TRUE(
            eventually([&] { return tail_of(state().log_file("axis-Y"), 1000).find("homed: ") != std::string::npos; }));
        ASSERT_TRUE(eventually([&] { return y().present(); }));
    }
};

TEST_F(KeptPositions, AKilledAxisAtRestRestartsHomed) {
    ASSERT_TRUE(y_is_kept());
    kill_y();
    EXPECT_TRUE(y().homed()) << tail_of(state().log_file("axis-Y"), 20);
    ASSERT_TRUE(becomes("Idle"));
    const Ran run = run_lockstep({"run", write("job.gcode", kShortJob)});
    EXPECT_EQ(run.code, 0) << run.out << run.err;
    EXPECT_EQ(y().position_steps(), 0);
    expect_verified();
}

TEST_F(KeptPositions, AnAxisKilledInMotionRestartsUnhomedAndReportsWhy) {
    ASSERT_TRUE(y_is_kept());
    const ChildProcess run(LOCKSTEP_COMMAND, {"run", write("job.gcode", kShortJob)});
    ASSERT_TRUE(becomes("Running"));
    ASSERT_TRUE(eventually([&] { return y().velocity_mm_s() > 1; }));
    kill_y();
    EXPECT_FALSE(y().homed());
    EXPECT_EQ(y().unproved().name(), "device-has-run");
    EXPECT_THAT(run_lockstep({"status"}).out, HasSubstr("Y is not homed, device-has-run"));
    ASSERT_TRUE(becomes("Fault"));
    EXPECT_EQ(run_lockstep({"reset"}).code, 0);
    EXPECT_EQ(run_lockstep({"home"}).code, 0);
    EXPECT_FALSE(y().has_unproved());
    expect_as_planned();
}

/// The log ends before another process moves the axis. It has the steps that this process found in the device.
TEST_F(KeptPositions, TheDeviceOfAKilledAxisContinuesAsPlanned) {
    const ChildProcess run(LOCKSTEP_COMMAND, {"run", write("job.gcode", kShortJob)});
    ASSERT_TRUE(becomes("Running"));
    ASSERT_TRUE(eventually([&] { return y().velocity_mm_s() > 1; }));
    kill_y();
    ASSERT_TRUE(becomes("Fault"));
    expect_as_planned();
}

/// Axes come to rest by themselves, and the end of the job is not recorded.
TEST_F(KeptPositions, AJobWhoseCoordinatorIsKilledRunsAsPlanned) {
    const ChildProcess run(LOCKSTEP_COMMAND, {"run", write("job.gcode", kShortJob)});
    ASSERT_TRUE(becomes("Running"));
    ASSERT_TRUE(eventually([&] { return y().velocity_mm_s() > 1; }));
    kill(process("coordinator"), SIGKILL);
    ASSERT_TRUE(becomes("Idle"));
    expect_verified();
}

TEST_F(KeptPositions, RefusesAKeptPositionOfAReplacedDevice) {
    ASSERT_TRUE(y_is_kept());
    ASSERT_EQ(run_lockstep({"down"}).code, 0);
    bring_up({"--fpga", "shm"});
    EXPECT_FALSE(y().homed());
    EXPECT_EQ(y().unproved().name(), "device-powered-up");
}

TEST_F(KeptPositions, ADamagedOneIsRefusedAndNamed) {
    ASSERT_TRUE(y_is_kept());
    std::filesystem::resize_file(file_of_y(), 20);
    kill_y();
    EXPECT_EQ(y().unproved().name(), "position-unreadable");
    EXPECT_THAT(tail_of(state().log_file("axis-Y"), 1000), HasSubstr("Y.textproto"));
}

}  // namespace
}  // namespace lockstep
