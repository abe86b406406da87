// Wrong input of a user leads to exit code 2, no action, and a message with the remedy.
#include <gmock/gmock.h>

#include "idl/proto/machine.pb.h"
#include "tests/integration/cli/own_machine.hpp"

namespace lockstep {
namespace {

using testing::HasSubstr;

class BadInput : public OwnMachine {
protected:
    static std::string refused(const Words& words) {
        const Ran ran = run_lockstep(words);
        EXPECT_EQ(ran.code, 2) << ran.out << ran.err;
        return ran.err;
    }
};

TEST_F(BadInput, OnTheCommandLineIsRefused) {
    EXPECT_THAT(refused({}), HasSubstr("--help"));
    EXPECT_THAT(refused({"dance"}), HasSubstr("--help"));
    EXPECT_THAT(refused({"run"}), HasSubstr("file is required"));
    EXPECT_THAT(refused({"run"}), HasSubstr("see: lockstep run --help"));
    EXPECT_THAT(refused({"move"}), HasSubstr("see: lockstep move --help"));
    EXPECT_THAT(refused({"override", "--feed", "nan"}), HasSubstr("see: lockstep override --help"));
    EXPECT_THAT(refused({"up", "--fpga", "real"}), HasSubstr("{sim,shm}"));
    EXPECT_THAT(refused({"move", "X"}), HasSubstr("X=10"));
    EXPECT_THAT(refused({"move", "X=201"}), HasSubstr("outside the travel"));
    EXPECT_THAT(refused({"home", "Q"}), HasSubstr("it has: X Y"));
    EXPECT_EQ(run_lockstep({"--help"}).code, 0);
    EXPECT_THAT(run_lockstep({"run", "--help"}).out, HasSubstr("Exit codes:"));
    EXPECT_THAT(run_lockstep({"--version"}).out, HasSubstr("lockstep "));
}

TEST_F(BadInput, InFilesIsRefusedWithThePlace) {
    EXPECT_THAT(refused({"run", "no-such-file.gcode"}), HasSubstr("no such file"));
    EXPECT_THAT(refused({"run", "/tmp"}), HasSubstr("directory"));
    EXPECT_THAT(refused({"status", "--machine", "no-such-file"}), HasSubstr("no such file"));
    const std::string bad = write("bad.textproto", "name: \"bad\"\nsped: 3\n");
    EXPECT_THAT(refused({"up", "--machine", bad}), HasSubstr(bad + ":2:"));
    unsetenv("LOCKSTEP_MACHINE");
    EXPECT_THAT(refused({"status"}), HasSubstr("--machine FILE"));
}

TEST_F(BadInput, InAMachineFileIsFoundByTheVerbThatOnlyChecksIt) {
    const std::string bad = write("bad.textproto", "name: \"bad\"\nsped: 3\n");
    EXPECT_THAT(refused({"machine", "check", bad}), HasSubstr(bad + ":2:"));
    EXPECT_THAT(refused({"machine"}), HasSubstr("see: lockstep machine --help"));
    const Ran good = run_lockstep({"machine", "check", file()});
    EXPECT_EQ(good.code, 0) << good.err;
    EXPECT_THAT(good.out, HasSubstr(file() + ": ok"));
    const auto machine = run_lockstep({"machine", "check", file(), "--json"}).json<proto::Machine>();
    EXPECT_EQ(machine.axis_size(), 2);
}

TEST_F(BadInput, AnAxisThatNoProgramMovesIsAWarningInEitherForm) {
    const std::string odd =
        write("odd.textproto",
              "name: \"odd\" axis { name: \"E\" steps_per_mm: 80 start_velocity_mm_s: 10 "
              "max_velocity_mm_s: 150 max_accel_mm_s2: 1500 position_min_mm: 0 position_max_mm: 9 }");
    const Ran text = run_lockstep({"machine", "check", odd});
    EXPECT_EQ(text.code, 0);
    EXPECT_THAT(text.err, HasSubstr("axis E: no word of G-code names it"));
    const Ran json = run_lockstep({"machine", "check", odd, "--json"});
    EXPECT_EQ(json.code, 0);
    EXPECT_THAT(json.out, HasSubstr("\"warnings\": [\n  \"axis E: no word of G-code names it"));
}

TEST_F(BadInput, IsReportedAsJsonOnRequest) {
    const auto usage = run_lockstep({"run", "--json"}).json<proto::ErrorReport>();
    EXPECT_THAT(usage.errors(0).message(), HasSubstr("file is required"));
    const std::string bad = write("bad.textproto", "name: \"bad\"\nsped: 3\n");
    const auto file = run_lockstep({"up", "--machine", bad, "--json"}).json<proto::ErrorReport>();
    EXPECT_EQ(file.errors(0).file(), bad);
    EXPECT_EQ(file.errors(0).line(), 2);
}

TEST_F(BadInput, InGcodeIsFoundBeforeAnythingIsSent) {
    bring_up();
    const std::string bad = write("bad.gcode", "G21 G90\nG1 X20 F100 Q3\n");
    EXPECT_THAT(refused({"run", bad}), HasSubstr(bad + ":2:"));
    const std::string far = write("far.gcode", "G21 G90\nG0 X201\n");
    EXPECT_THAT(refused({"run", far}), HasSubstr(far + ":2:"));
    EXPECT_FALSE(status().has_job());
}

TEST_F(BadInput, IsNotAMachineThatIsDown) {
    const Ran status = run_lockstep({"status"});
    EXPECT_EQ(status.code, 3);
    EXPECT_THAT(status.err, HasSubstr("lockstep up --machine " + file()));
}

}  // namespace
}  // namespace lockstep
