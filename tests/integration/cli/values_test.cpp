// Offsets and tools that outlive programs and processes: listed, changed, and used by programs.
#include <gmock/gmock.h>
#include <signal.h>

#include <fstream>

#include "idl/proto/values.pb.h"
#include "services/documents/values/values_document.hpp"
#include "services/files/directories.hpp"
#include "tests/integration/cli/own_machine.hpp"
#include "tests/integration/wire/eventually.hpp"

namespace lockstep {
namespace {

using testing::AllOf;
using testing::HasSubstr;

class Values : public OwnMachine {
protected:
    void SetUp() override {
        OwnMachine::SetUp();
        bring_up();
    }
    static Ran offsets(const Words& words) {
        Words all{"offsets"};
        all.insert(all.end(), words.begin(), words.end());
        return run_lockstep(all);
    }
    static proto::KeptValues kept() { return offsets({"--json"}).json<proto::KeptValues>(); }
    static void home() {
        const Ran home = run_lockstep({"home"});
        ASSERT_EQ(home.code, 0) << home.out << home.err;
    }
    Ran run(const std::string& gcode) const { return run_lockstep({"run", write("job.gcode", gcode), "--json"}); }
    void restart_coordinator() const {
        const pid_t before = process("coordinator");
        kill(before, SIGKILL);
        ASSERT_TRUE(eventually([&] { return process("coordinator") != 0 && process("coordinator") != before; }));
        ASSERT_TRUE(eventually([&] { return run_lockstep({"status"}).code == 0; }));
    }
};

TEST_F(Values, AreOnDiskWhenTheirCommandReturns) {
    for (int x = 1; x <= 3; ++x) {
        const Ran set = offsets({"set", "G55", "X=" + std::to_string(x), "R=30"});
        ASSERT_EQ(set.code, 0) << set.err;
        restart_coordinator();
        ASSERT_EQ(kept().system_size(), 1);
        EXPECT_EQ(kept().system(0).origin().x(), x);
        EXPECT_EQ(kept().system(0).rotation(), 30);
    }
}

TEST_F(Values, AreTouchedOffWhereTheMachineStands) {
    EXPECT_EQ(run_lockstep({"touch", "X=0"}).code, 2) << "it is not homed";
    home();
    ASSERT_EQ(run_lockstep({"move", "X=50", "Y=-20"}).code, 0);
    const Ran touched = run_lockstep({"touch", "X=0", "Y=5"});
    ASSERT_EQ(touched.code, 0) << touched.err;
    EXPECT_EQ(kept().system(0).origin().x(), 50);
    EXPECT_EQ(kept().system(0).origin().y(), -25);
    const auto report = run("G0 X1 Y5\nM2\n").json<proto::RunReport>();
    EXPECT_DOUBLE_EQ(report.final_positions(0).position_mm(), 51);
    EXPECT_DOUBLE_EQ(report.final_positions(1).position_mm(), -20);
}

TEST_F(Values, AreUsedByProgramsAndChangedAtTheirEnd) {
    home();
    ASSERT_EQ(offsets({"set", "G54", "X=100", "Y=10"}).code, 0);
    const auto report = run("G0 X-20 Y1\nG10 L2 P2 X7\nM2\n").json<proto::RunReport>();
    EXPECT_DOUBLE_EQ(report.final_positions(0).position_mm(), 80);
    EXPECT_DOUBLE_EQ(report.final_positions(1).position_mm(), 11);
    ASSERT_EQ(kept().system_size(), 2);
    EXPECT_EQ(kept().system(1).origin().x(), 7);
    EXPECT_EQ(run("G55 G0 X1\nM2\n").json<proto::RunReport>().final_positions(0).position_mm(), 8);
}

TEST_F(Values, AreNotChangedByAProgramThatWasStoppedNorDuringOne) {
    home();
    const ChildProcess running(LOCKSTEP_COMMAND,
                               {"run", write("job.gcode", "G10 L2 P3 X9\n" + std::string(kThereAndBack))});
    ASSERT_TRUE(becomes("Running"));
    const Ran meanwhile = offsets({"set", "G54", "X=1"});
    EXPECT_EQ(meanwhile.code, 1);
    EXPECT_THAT(meanwhile.err, HasSubstr("a job in progress uses these values"));
    ASSERT_EQ(run_lockstep({"stop"}).code, 0);
    ASSERT_TRUE(becomes("Idle"));
    EXPECT_EQ(kept().system_size(), 0);
}

TEST_F(Values, OfToolsAreListedSetAndRemoved) {
    EXPECT_THAT(run_lockstep({"tools"}).out, HasSubstr("no tools"));
    ASSERT_EQ(run_lockstep({"tools", "set", "3", "D=6", "P=2", "X=1.5"}).code, 0);
    EXPECT_THAT(run_lockstep({"tools"}).out, HasSubstr("T3       X 1.5  Y 0  D 6  P 2"));
    EXPECT_EQ(kept().tool(0).number(), 3);
    const Ran wrong = run_lockstep({"tools", "set", "3", "Q=10"});
    EXPECT_EQ(wrong.code, 2);
    EXPECT_THAT(wrong.err, HasSubstr("not a whole number from 0 to 9"));
    EXPECT_EQ(run_lockstep({"tools", "remove", "3"}).code, 0);
    EXPECT_EQ(run_lockstep({"tools", "remove", "3"}).code, 2);
    EXPECT_EQ(kept().tool_size(), 0);
}

TEST_F(Values, AreTheInputOfACheckWithoutAMachine) {
    ASSERT_EQ(offsets({"set", "G54", "X=190"}).code, 0);
    const std::string job = write("job.gcode", "G0 X20\nM2\n");
    EXPECT_EQ(run_lockstep({"check", job}).code, 2);
    EXPECT_EQ(run_lockstep({"check", job, "--values", write("values.textproto", "revision: 1\n")}).code, 0);
    EXPECT_THAT(run_lockstep({"check", job, "--values", write("bad.textproto", "sistem {}\n")}).err,
                HasSubstr("bad.textproto:1"));
}

TEST_F(Values, OfADamagedFileAreRefusedWithTheRemedy) {
    ASSERT_EQ(offsets({"set", "G54", "X=1"}).code, 0);
    const std::filesystem::path file = values_file(status().machine());
    ASSERT_EQ(run_lockstep({"down"}).code, 0);
    std::ofstream(file) << "revision: 1\nsystem { name: \"G5";
    const Ran up = run_lockstep({"up"});
    EXPECT_NE(up.code, 0);
    const auto names_it = AllOf(HasSubstr("values.textproto:2:"), HasSubstr("or remove it to begin without"));
    EXPECT_THAT(up.out + up.err, names_it);
    for (const char* verb : {"status", "offsets"}) { EXPECT_THAT(run_lockstep({verb}).err, names_it); }
    EXPECT_THAT(run_lockstep({"status", "--json"}).out, HasSubstr("values.textproto:2:"));
    std::filesystem::remove(file);
    bring_up();
    EXPECT_EQ(kept().system_size(), 0);
}

TEST_F(Values, ThatCannotBeWrittenAreReported) {
    const std::filesystem::path file = values_file(status().machine());
    std::filesystem::create_directories(file);
    const Ran set = offsets({"set", "G54", "X=1"});
    EXPECT_EQ(set.code, 1);
    EXPECT_THAT(set.err, HasSubstr("they may be lost when the coordinator ends"));
    EXPECT_THAT(text_of_log("coordinator"), HasSubstr("the machine's offsets and tools are not kept"));
    EXPECT_THAT(text_of_log("coordinator"), HasSubstr("make room on the disk"));
    const Ran listed = offsets({});
    EXPECT_THAT(listed.out, HasSubstr("G54")) << "they are used";
    EXPECT_THAT(listed.err, AllOf(HasSubstr("not on the coordinator's disk"), HasSubstr("make room on the disk")));
    EXPECT_THAT(offsets({"--json"}).out, AllOf(HasSubstr("\"G54\""), HasSubstr("\"warnings\"")));
    EXPECT_TRUE(status().unsaved_values());
    EXPECT_THAT(run_lockstep({"status"}).out, HasSubstr("not on the coordinator's disk"));
    std::filesystem::remove(file);
    EXPECT_TRUE(eventually([&] { return read_values(file)->revision == 1; })) << "the write is repeated";
    EXPECT_TRUE(eventually([&] { return !status().unsaved_values(); }));
    EXPECT_THAT(offsets({"--json"}).out, testing::Not(HasSubstr("warnings")));
}

}  // namespace
}  // namespace lockstep
