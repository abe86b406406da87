// The command as used by a person or a script: its output and exit codes.
#include <google/protobuf/util/json_util.h>
#include <gtest/gtest.h>
#include <sys/wait.h>

#include <array>
#include <cstdio>
#include <filesystem>
#include <fstream>
#include <string>

#include "idl/proto/report.pb.h"

namespace lockstep {
namespace {

struct Ended {
    int exit = -1;
    std::string out;
};

Ended run(const std::string& words) {
    Ended ended;
    FILE* pipe = popen((std::string(LOCKSTEP_COMMAND) + " " + words).c_str(), "r");
    std::array<char, 4096> part{};
    while (const std::size_t got = std::fread(part.data(), 1, part.size(), pipe)) {
        ended.out.append(part.data(), got);
    }
    ended.exit = WEXITSTATUS(pclose(pipe));
    return ended;
}

template <typename Report>
Report report_of(const Ended& ended) {
    Report report;
    EXPECT_TRUE(google::protobuf::util::JsonStringToMessage(ended.out, &report).ok()) << ended.out;
    return report;
}

class Command : public testing::Test {
protected:
    Command() {
        std::filesystem::remove_all(directory);
        std::filesystem::create_directories(directory);
    }
    std::string file(const std::string& name, const std::string& text) const {
        std::ofstream(directory / name) << text;
        return (directory / name).string();
    }
    std::filesystem::path directory = std::filesystem::path(testing::TempDir()) / "lockstep_command" /
                                      testing::UnitTest::GetInstance()->current_test_info()->name();
    std::string log = (directory / "plate.lcm").string();
    std::string plate = "deploy/examples/plate.gcode --machine deploy/examples/three-axis.textproto";
};

TEST_F(Command, PlanSimulateAnalyzeVerify) {
    const auto plan = run("plan " + plate + " --json");
    ASSERT_EQ(plan.exit, 0);
    const auto planned = report_of<proto::PlanReport>(plan);
    const auto simulated = run("simulate " + plate + " --log " + log + " --json");
    ASSERT_EQ(simulated.exit, 0);
    const auto done = report_of<proto::RunReport>(simulated);
    EXPECT_EQ(done.outcome(), "done");
    EXPECT_DOUBLE_EQ(done.real_s(), planned.duration_s());
    EXPECT_DOUBLE_EQ(done.planned_s(), planned.duration_s());

    const auto analysed = report_of<proto::AnalysisReport>(run("analyze " + log + " --json"));
    ASSERT_EQ(analysed.axes_size(), 3);
    EXPECT_GT(analysed.axes(0).steps(), planned.axes(0).steps());  // plus those of homing
    const auto verified = run("verify " + log + " --json");
    EXPECT_EQ(verified.exit, 0);
    const auto result = report_of<proto::VerifyReport>(verified);
    EXPECT_TRUE(result.exact());
    EXPECT_EQ(result.steps_compared(), analysed.axes(0).steps() + analysed.axes(1).steps() + analysed.axes(2).steps());
}

TEST_F(Command, PicturesAndTables) {
    EXPECT_EQ(run("plan " + plate + " --svg " + (directory / "plan").string()).exit, 0);
    ASSERT_EQ(run("simulate " + plate + " --log " + log + " --speed-report").exit, 0);
    const std::string to = (directory / "log").string();
    EXPECT_EQ(run("analyze " + log + " --no-color --svg " + to + " --csv " + to).exit, 0);
    for (const char* name : {"plan/xy.svg", "plan/speed.svg", "log/xy.svg", "log/speed.svg", "log/steps_X.csv"}) {
        EXPECT_GT(std::filesystem::file_size(directory / name), 1000U) << name;
    }
}

constexpr const char* kMachine = " --machine deploy/examples/three-axis.textproto";

TEST_F(Command, MovesAreListedBeforeArcsAreCut) {
    const std::string file = (directory / "arc.ngc").string();
    const std::string moves = (directory / "moves.csv").string();
    std::ofstream(file) << "G0 X20 Y20\nG2 X40 I10 F600\nG4 P1\nM8\n";
    EXPECT_EQ(run("plan " + file + kMachine + " --start X=0,Y=0,Z=5 --moves " + moves).exit, 0);
    std::ifstream in(moves);
    const std::string text{std::istreambuf_iterator<char>(in), {}};
    EXPECT_EQ(text,
              "line,kind,X,Y,Z,feed_mm_min,i,j,k\n1,rapid,20,20,5,,,,\n2,arc_cw,40,20,5,600,30,20,5\n"
              "3,dwell,40,20,5,,,,\n");
}

TEST_F(Command, MovesOfALongFileAreListedAsTheyAreRead) {
    const std::string file = (directory / "long.ngc").string();
    const std::string moves = (directory / "moves.csv").string();
    constexpr int kLines = 120'000;
    {
        std::ofstream out(file);
        out << "G0 X20 Y20 F6000\n";
        for (int k = 0; k < kLines; ++k) { out << "G1 X" << 20 + 0.0001 * (k % 2) << " Y20.5000 Z5.0000\n"; }
    }
    EXPECT_EQ(run("plan " + file + kMachine + " --start X=0,Y=0,Z=5 --moves " + moves).exit, 0);
    std::ifstream in(moves);
    std::string row;
    std::string last;
    int rows = 0;
    for (; std::getline(in, row); last = row) { ++rows; }
    EXPECT_EQ(rows, kLines + 2);
    EXPECT_EQ(last, "120001,feed,20.0001,20.5,5,6000,,,");
    const auto full = run("plan " + file + kMachine + " --start X=0,Y=0,Z=5 --moves /dev/full 2>&1");
    EXPECT_EQ(full.exit, 2);
    EXPECT_NE(full.out.find("/dev/full: cannot be written"), std::string::npos) << full.out;
}

TEST_F(Command, CheckReportsErrorsAndWordsThatArePassedOver) {
    const std::string file = (directory / "words.ngc").string();
    std::ofstream(file) << "G0 X20 Y20\nM3 S100\n";
    const auto refused = run("check " + file + kMachine + " 2>&1");
    EXPECT_EQ(refused.exit, 2);
    EXPECT_NE(refused.out.find("--ignore-unassigned"), std::string::npos) << refused.out;
    const auto passed = run("check " + file + kMachine + " --ignore-unassigned 2>&1");
    EXPECT_EQ(passed.exit, 0);
    EXPECT_NE(passed.out.find("line 2: the spindle is not configured"), std::string::npos) << passed.out;
}

TEST_F(Command, WordsForMissingDevicesArePassedOverWhereTheMachineSaysSo) {
    std::ifstream example("deploy/examples/three-axis.textproto");
    const std::string text{std::istreambuf_iterator<char>(example), {}};
    const std::string machine = " --machine " + file("mill.textproto", text + "\nunassigned { spindle: IGNORE }\n");
    const std::string words = file("words.ngc", "G0 X20 Y20\nM3 S100\n");
    for (const std::string& verb : {"check " + words, "plan " + words, "simulate " + words + " --log " + log}) {
        const auto passed = run(verb + machine + " 2>&1");
        EXPECT_EQ(passed.exit, 0) << passed.out;
        EXPECT_NE(passed.out.find("line 2: the spindle is not configured"), std::string::npos) << passed.out;
    }
    const auto refused = run("check " + file("output.ngc", "M64 P1\n") + machine + " 2>&1");
    EXPECT_EQ(refused.exit, 2);
    EXPECT_NE(refused.out.find("outputs: IGNORE"), std::string::npos) << refused.out;
}

TEST_F(Command, SubroutinesAreFoundInTheConfiguredDirectory) {
    std::ifstream example("deploy/examples/three-axis.textproto");
    const std::string text{std::istreambuf_iterator<char>(example), {}};
    const auto parts = directory / "parts";
    std::filesystem::create_directories(parts);
    std::ofstream(parts / "hole.ngc") << "o<hole> sub\nG0 X#1\no<hole> endsub\n";
    const std::string program = "check " + file("part.ngc", "o<hole> call [20]\n");
    EXPECT_EQ(run(program + kMachine + " 2>&1").exit, 2);
    const std::string machine =
        text + "\nsubroutine_directory: \"" + std::filesystem::absolute(parts).string() + "\"\n";
    EXPECT_EQ(run(program + " --machine " + file("mill.textproto", machine) + " 2>&1").exit, 0);
}

TEST_F(Command, ALogThatLacksItsEndDoesNotVerify) {
    ASSERT_EQ(run("simulate " + plate + " --log " + log).exit, 0);
    std::filesystem::resize_file(log, std::filesystem::file_size(log) / 2);
    const auto verified = run("verify " + log);
    EXPECT_EQ(verified.exit, 1);
    EXPECT_NE(verified.out.find("unknown: the log ends before job 2, run plate.gcode does"), std::string::npos)
        << verified.out;
}

TEST_F(Command, AReplayMakesTheStepsOfTheLogAndALogThatVerifies) {
    ASSERT_EQ(run("simulate " + plate + " --log " + log).exit, 0);
    const std::string again = (directory / "again.lcm").string();
    const auto replayed = run("replay " + log + " --log " + again + " --json");
    EXPECT_EQ(replayed.exit, 0);
    const auto made = report_of<proto::ReplayReport>(replayed);
    EXPECT_TRUE(made.exact());
    EXPECT_EQ(made.log(), again);
    const auto result = report_of<proto::VerifyReport>(run("verify " + again + " --json"));
    EXPECT_TRUE(result.exact());
    EXPECT_EQ(result.steps_compared(), made.steps_replayed());
    EXPECT_EQ(run("replay deploy/examples/plate.gcode 2>&1").exit, 2);
    EXPECT_EQ(run("replay " + log + " --log " + log + " 2>&1").exit, 2) << "the recorded log stays";
    EXPECT_EQ(run("export " + log + " --force --out " + log + " 2>&1").exit, 2);
    EXPECT_EQ(run("replay " + log + " --log deploy/examples/plate.gcode 2>&1").exit, 2) << "that is no log";
}

TEST_F(Command, BadInputIsReportedWithItsPlaceAndExits2) {
    const std::string bad = file("bad.gcode", "G21 G90\nG1 X10 F100\nG1 X900\n");
    const std::string machine = " --machine deploy/examples/three-axis.textproto";
    const auto planned = run("plan " + bad + machine + " 2>&1");
    EXPECT_EQ(planned.exit, 2);
    EXPECT_NE(planned.out.find("bad.gcode:3:"), std::string::npos) << planned.out;
    const auto json = report_of<proto::ErrorReport>(run("plan " + bad + machine + " --json"));
    ASSERT_EQ(json.errors_size(), 1);
    EXPECT_EQ(json.errors(0).line(), 3);
    EXPECT_EQ(run("simulate " + bad + machine + " --log " + log + " 2>&1").exit, 2);
    EXPECT_FALSE(std::filesystem::exists(log));
}

/// A program of 70,002 lines, more than 2 MB.
std::string long_program() {
    std::string text = "G21 G90 F6000\nG0 X20 Y20\n";
    for (int k = 0; k < 35'000; ++k) { text += "G1 X20.0125 Y20.0000 Z5.0000 (there)\nG1 X20.0000 (and back)\n"; }
    return text;
}

TEST_F(Command, ALongFileIsSimulatedAsItIsRead) {
    const std::string job = file("long.gcode", long_program()) + " --machine deploy/examples/three-axis.textproto";
    ASSERT_GT(std::filesystem::file_size(directory / "long.gcode"), 2'000'000U);
    const auto planned = report_of<proto::PlanReport>(run("plan " + job + " --json"));
    const auto simulated = run("simulate " + job + " --log " + log + " --json");
    ASSERT_EQ(simulated.exit, 0);
    const auto done = report_of<proto::RunReport>(simulated);
    EXPECT_EQ(done.outcome(), "done");
    EXPECT_EQ(done.name(), "long.gcode");
    const auto drawn =
        report_of<proto::PlanReport>(run("plan " + job + " --json --svg " + (directory / "plan").string()));
    EXPECT_DOUBLE_EQ(done.real_s(), drawn.duration_s()) << "pictures are drawn from the frames";
    EXPECT_NEAR(done.real_s(), planned.duration_s(), 1e-3 * planned.duration_s()) << "frames may be made again, slower";
    EXPECT_TRUE(report_of<proto::VerifyReport>(run("verify " + log + " --json")).exact());
}

TEST_F(Command, ALongFileWithAnErrorIsNotSimulated) {
    const std::string job = file("long.gcode", long_program() + "G1 X900\nG1 X20\nG1 Q1\n");
    const auto simulated =
        run("simulate " + job + " --machine deploy/examples/three-axis.textproto --log " + log + " 2>&1");
    EXPECT_EQ(simulated.exit, 2);
    EXPECT_NE(simulated.out.find("long.gcode:70003:"), std::string::npos) << simulated.out;
    EXPECT_NE(simulated.out.find("long.gcode:70005:"), std::string::npos) << simulated.out;
    EXPECT_FALSE(std::filesystem::exists(log));
}

TEST_F(Command, EachMachineOfALogCanBeAnalyzedByItsName) {
    const std::string program = file("line.gcode", "G1 X6 F600\n");
    const std::string both = (directory / "both.lcm").string();
    for (const char* machine : {"three-axis", "two-axis"}) {
        const std::string of = std::string(" --machine deploy/examples/") + machine + ".textproto";
        ASSERT_EQ(run("simulate " + program + of + " --log " + log).exit, 0);
        std::ofstream(both, std::ios::app | std::ios::binary) << std::ifstream(log, std::ios::binary).rdbuf();
    }
    const auto first = report_of<proto::AnalysisReport>(run("analyze " + both + " --json"));
    ASSERT_EQ(first.machine(), "mill");
    const std::string text = run("analyze " + both + " --no-html").out;
    const std::size_t remedy = text.find("--machine ");
    ASSERT_NE(remedy, std::string::npos) << text;
    const std::string words = text.substr(remedy, text.find(" analyzes it") - remedy);
    const auto other = report_of<proto::AnalysisReport>(run("analyze " + both + " --json " + words));
    EXPECT_EQ(other.axes_size(), 2);
    EXPECT_NE(other.machine(), first.machine());
    EXPECT_EQ(run("analyze " + both + " --machine nowhere 2>&1").exit, 2);
}

TEST_F(Command, AFileThatIsNotALogExits2) {
    EXPECT_EQ(run("verify deploy/examples/plate.gcode 2>&1").exit, 2);
    EXPECT_EQ(run("analyze deploy/examples/plate.gcode 2>&1").exit, 2);
    EXPECT_EQ(run("verify /nowhere.lcm 2>&1").exit, 2);
    EXPECT_EQ(run("verify 2>&1").exit, 2);
}

TEST_F(Command, AStartElsewhere) {
    const std::string line = file("line.gcode", "G0 X20\n");
    const std::string machine = " --machine deploy/examples/three-axis.textproto --json";
    const auto parked = report_of<proto::PlanReport>(run("plan " + line + machine));
    const auto placed = report_of<proto::PlanReport>(run("plan " + line + machine + " --start X=10,Y=5"));
    EXPECT_DOUBLE_EQ(parked.length_mm(), 15);
    EXPECT_DOUBLE_EQ(placed.length_mm(), 10);
    EXPECT_EQ(run("plan " + line + machine + " --start W=10").exit, 2);
    EXPECT_EQ(run("plan " + line + machine + " --start X=1000").exit, 2);
    EXPECT_EQ(run("plan " + line + machine + " --start X").exit, 2);
}

TEST_F(Command, AFileThatIsNoLogIsNotReplaced) {
    const std::string notes = file("notes.txt", "mine\n");
    EXPECT_EQ(run("simulate " + plate + " --log " + notes + " 2>&1").exit, 2);
    EXPECT_EQ(std::filesystem::file_size(notes), 5U);
    EXPECT_EQ(run("simulate " + plate + " --force --log " + notes).exit, 0);
    EXPECT_EQ(run("verify " + notes).exit, 0);
}

}  // namespace
}  // namespace lockstep
