// A program is sent through lockstep send and lockstep-grbl. A person or a wrong line can stop it.
#include <gmock/gmock.h>
#include <signal.h>

#include "tests/integration/cli/own_machine.hpp"
#include "tests/integration/wire/eventually.hpp"

namespace lockstep {
namespace {

using testing::AllOf;
using testing::HasSubstr;

constexpr const char* kPort = "2398";

class SentProgram : public OwnMachine {
protected:
    void SetUp() override {
        OwnMachine::SetUp();
        bring_up();
        terminal_ = (folder() / "grbl").string();
        grbl_.emplace(LOCKSTEP_GRBL, Words{"--port", kPort, "--pty", terminal_});
        ASSERT_TRUE(eventually([&] { return grbl_->out().contains("accepts grbl's protocol"); }));
    }
    void TearDown() override {
        grbl_->signal(SIGTERM);
        EXPECT_EQ(grbl_->wait().code, 0);
        OwnMachine::TearDown();
    }
    /// A program of 200 short lines, from X20 to X120.
    std::string wave() const {
        std::string text = "%\n$H (first)\nG21 G90 G94\nG1 X20 Y0 F6000 ; to the start!\n";
        for (int i = 0; i <= 200; ++i) {
            text += "G1 X" + std::to_string(20 + i * 0.5) + " Y" + std::to_string(i % 10) + "\n";
        }
        return write("wave.gcode", text + "M2\n");
    }
    static proto::SendReport report_of(const Ran& ran) { return ran.json<proto::SendReport>(); }

    std::string terminal_;
    std::optional<ChildProcess> grbl_;
};

TEST_F(SentProgram, IsRunToItsEndAndEveryStepIsAsPlanned) {
    record();
    const std::string file = wave();
    const Ran ran = run_lockstep({"send", file, "--port", "127.0.0.1:" + std::string(kPort), "--json"});
    ASSERT_EQ(ran.code, 0) << ran.err;
    EXPECT_TRUE(report_of(ran).done());
    EXPECT_EQ(report_of(ran).accepted_lines(), 205);
    EXPECT_EQ(report_of(ran).buffer_bytes(), 4095) << "as $I reports it";
    EXPECT_EQ(status().axes(0).position_steps(), 120 * 80);
    const Ran again = run_lockstep({"send", file, "--port", terminal_, "--lines"});
    EXPECT_EQ(again.code, 0) << again.err;
    EXPECT_THAT(again.out, HasSubstr("205 lines accepted and run in "));
    EXPECT_EQ(status().axes(0).position_steps(), 120 * 80);
    expect_verified();
}

TEST_F(SentProgram, EndsWhereTheSameFileEndsByRun) {
    const std::string file =
        write("parameters.gcode",
              "%\n#1=50 (the width)\n#<step>=[#1/4]\nG21 G90 G0 X#1 Y0\nG91\n"
              "G1 X-#<step> F3000\nX0.004\nX0.004\nX0.004\nX0.004\nG10 L2 P1 X3\nG90 G0 Y[#5420/10]\n"
              "M2\n%\nG0 X0 Y0\n");
    ASSERT_EQ(run_lockstep({"home"}).code, 0);
    ASSERT_EQ(run_lockstep({"run", file}).code, 0);
    const std::vector<std::int64_t> by_run{status().axes(0).position_steps(), status().axes(1).position_steps()};
    EXPECT_EQ(by_run[0], 3001) << "37.516 mm";
    for (const char* way : {"--lines", "--json"}) {
        ASSERT_EQ(run_lockstep({"offsets", "clear", "G54"}).code, 0);
        const Ran ran = run_lockstep({"send", file, "--port", terminal_, way});
        ASSERT_EQ(ran.code, 0) << ran.err << ran.out;
        EXPECT_EQ(status().axes(0).position_steps(), by_run[0]) << way;
        EXPECT_EQ(status().axes(1).position_steps(), by_run[1]) << way;
    }
}

TEST_F(SentProgram, StopsAtALineThatIsRefusedAndNamesIt) {
    const std::string file = write("wrong.gcode", "$H\nG21 G90\nG1 X30 F600\nG41 D1\nG1 X200\n");
    const Ran ran = run_lockstep({"send", file, "--port", terminal_});
    EXPECT_EQ(ran.code, 1);
    EXPECT_THAT(ran.err, AllOf(HasSubstr("wrong.gcode:4: G41 D1: error:20 Unsupported command."),
                               HasSubstr("The controller: ")));
    EXPECT_TRUE(becomes("Idle"));
    EXPECT_LE(status().axes(0).position_steps(), 30 * 80);
}

TEST_F(SentProgram, IsStoppedByCtrlC) {
    const std::string file = write("long.gcode", "$H\nG21 G90\nG1 X190 F600\nG1 X10\n");
    ChildProcess send(LOCKSTEP_COMMAND, {"send", file, "--port", "127.0.0.1:" + std::string(kPort), "--json"});
    EXPECT_TRUE(becomes("Running"));
    EXPECT_TRUE(eventually([&] { return status().axes(0).position_steps() > 5 * 80; }));
    send.signal(SIGINT);
    const Ran ran = send.wait();
    EXPECT_EQ(ran.code, 1);
    EXPECT_TRUE(report_of(ran).stopped());
    EXPECT_TRUE(becomes("Idle"));
    EXPECT_LT(status().axes(0).position_steps(), 190 * 80);
}

TEST_F(SentProgram, IsCheckedBeforeAnythingIsSent) {
    const std::string file = write("bang.gcode", "G1 X10 F600\nG1 X20 !\n");
    const Ran ran = run_lockstep({"send", file, "--port", terminal_});
    EXPECT_EQ(ran.code, 2);
    EXPECT_THAT(ran.err, HasSubstr("bang.gcode:2:1: error: the byte '!'"));
    EXPECT_EQ(run_lockstep({"send", wave(), "--port", "127.0.0.1:1"}).code, 3);
    EXPECT_EQ(run_lockstep({"send", wave(), "--port", "/nowhere"}).code, 3);
    EXPECT_EQ(run_lockstep({"send", wave(), "--port", terminal_, "--baud", "7"}).code, 2);
}

}  // namespace
}  // namespace lockstep
