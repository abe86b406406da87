// `lockstep check` and `lockstep plan` need little memory for every program, also for a short text of many blocks.
#include <gtest/gtest.h>
#include <sys/resource.h>
#include <sys/wait.h>
#include <unistd.h>

#include <filesystem>
#include <fstream>
#include <functional>
#include <string>

namespace lockstep {
namespace {

constexpr double kMost_mb = 64;

struct Program {
    const char* name;
    std::function<std::string()> text;
};

std::string repeated(const std::string& lines, int times) {
    std::string text;
    for (int k = 0; k < times; ++k) { text += lines; }
    return text;
}

const Program kPrograms[] = {
    {"Splines", [] { return repeated("G5 I0.3 J0.1 P-0.3 Q0.1 X21 Y20\nG5 I-0.3 J0.1 P0.3 Q0.1 X20 Y20\n", 2000); }},
    {"Nurbs",
     [] {
         std::string text = "G5.2 X20 Y20 P1 L3\n";
         for (int k = 1; k < 4900; ++k) {
             text += "X" + std::to_string(20 + k % 7) + " Y" + std::to_string(20 + k % 5) + " P1\n";
         }
         return text + "G5.3\n";
     }},
    {"LoopOfLines", [] { return std::string("o1 repeat [200000]\nG1 X21\nX20\no1 endrepeat\n"); }},
    {"LoopOfArcs", [] { return std::string("o1 repeat [100000]\nG2 X21 I0.5\nG2 X20 I-0.5\no1 endrepeat\n"); }},
    {"LoopOfHelices", [] { return std::string("o1 repeat [60000]\nG2 X20 I1 Z11\nG2 X20 I1 Z10\no1 endrepeat\n"); }},
    {"SubroutineBehindItsCall",
     [] { return "o1 call\nM2\no1 sub\no2 repeat [150000]\nG1 X21\nX20\no2 endrepeat\no1 endsub\n"; }},
    {"Cycle", [] { return std::string("G91\nG81 X0.0001 Y0 Z-1 R-1 L90000\n"); }},
    {"Dwells", [] { return std::string("o1 repeat [150000]\nG4 P0.001\nG1 X21\nX20\no1 endrepeat\n"); }},
    {"LongFileOfLines", [] { return repeated("G1 X21.0000 Y20.0000\nG1 X20.0000 Y20.0000\n", 100'000); }},
    {"LongFileOfHelices", [] { return repeated("G2 X20.0000 I1.0000 Z11\nG2 X20.0000 I1.0000 Z10\n", 25'000); }},
    {"WrongAtTheEnd", [] { return std::string("o1 repeat [200000]\nG1 X21\nX20\no1 endrepeat\nG1 X9999\n"); }},
};

class PlanMemory : public testing::TestWithParam<Program> {};

/// Runs the command without output. Returns its greatest memory in MB.
double memory_of(const char* verb, const std::string& file, int& exit_code) {
    const pid_t child = fork();
    if (child == 0) {
        (void)!freopen("/dev/null", "w", stdout);
        (void)!freopen("/dev/null", "w", stderr);
        execl(LOCKSTEP_COMMAND, LOCKSTEP_COMMAND, verb, file.c_str(), "--machine",
              "deploy/examples/three-axis.textproto", nullptr);
        _exit(127);
    }
    int status = 0;
    rusage used{};
    wait4(child, &status, 0, &used);
    exit_code = WIFEXITED(status) ? WEXITSTATUS(status) : -1;
    return static_cast<double>(used.ru_maxrss) / 1024;
}

TEST_P(PlanMemory, IsBounded) {
    const std::string file = testing::TempDir() + "lockstep-plan-memory-" + GetParam().name + ".ngc";
    std::ofstream(file) << "G21 G90 F3000\nG0 X20 Y20 Z10\n" << GetParam().text();
    const int expected = std::string(GetParam().name) == "WrongAtTheEnd" ? 2 : 0;
    for (const char* verb : {"check", "plan"}) {
        int exit_code = 0;
        EXPECT_LE(memory_of(verb, file, exit_code), kMost_mb) << verb;
        EXPECT_EQ(exit_code, expected) << verb;
    }
    std::filesystem::remove(file);
}

INSTANTIATE_TEST_SUITE_P(OfEachKind, PlanMemory, testing::ValuesIn(kPrograms),
                         [](const auto& of) { return of.param.name; });

}  // namespace
}  // namespace lockstep
