// A scenario is accepted whole, or refused with place, value, limit and remedy.
#include <gmock/gmock.h>

#include <filesystem>

#include "clients/scenario/model/scenario_text.hpp"
#include "tests/unit/scenario/scenario_text.hpp"

namespace lockstep::scenario {
namespace {

using testing::AllOf;
using testing::HasSubstr;
using testing::StartsWith;

TEST(ScenarioReading, AcceptsValidScenario) {
    const Scenario scenario = parsed(
        whole("step { run { gcode: \"G21 G90\\nG1 X10 Y5 F600\" }\n"
              "  during { line: 2 after_s: 0.2 act { pause: \"axis-Y\" for_s: 0.04 } rests_within_frames: 5 } }\n"
              "expect { final { axis: \"X\" mm: 10 } vetoes {} }"));
    EXPECT_EQ(scenario.asked.step_size(), 2);
    EXPECT_EQ(scenario.machine.axes.size(), 2);
    EXPECT_EQ(processes_of(scenario.asked, scenario.machine),
              (std::vector<std::string>{"coordinator", "axis-X", "axis-Y"}));
}

TEST(ScenarioReading, AcceptsAndOutlinesEveryInstalledScenario) {
    int count = 0;
    for (const auto& entry : std::filesystem::recursive_directory_iterator(LOCKSTEP_SCENARIOS)) {
        const bool is_scenario =
            entry.path().extension() == ".textproto" && entry.path().parent_path().filename() != "machines";
        if (!is_scenario) { continue; }
        const auto scenario = load_scenario(entry.path());
        ASSERT_TRUE(scenario) << to_text(entry.path().string(), scenario.error());
        EXPECT_THAT(outline(*scenario), AllOf(HasSubstr(scenario->asked.shows()), HasSubstr("  step     home")));
        ++count;
    }
    EXPECT_GE(count, 30);
}

TEST(ScenarioReading, GivesTheMachineANetworkOfItsOwn) {
    const Scenario scenario = parsed(whole("place: NAMESPACE"));
    EXPECT_EQ(scenario.machine.network.interface, "eth0");
    EXPECT_THAT(scenario.machine.network.lcm_url, HasSubstr("ttl=1"));
    EXPECT_EQ(parsed(whole("")).machine.network.interface, "lo");
}

TEST(ScenarioReading, SharesMemoryOnlyWithoutLinks) {
    MachineSetup machine;
    machine.network.one_host = true;
    EXPECT_TRUE(isolated(machine, Asked::PROCESS).network.one_host);
    EXPECT_FALSE(isolated(machine, Asked::NAMESPACE).network.one_host);
    EXPECT_FALSE(isolated(machine, Asked::CONTAINER).network.one_host);
}

TEST(ScenarioReading, OptionOverridesPlaceOfTheScenario) {
    const std::string cut = whole("step { act { cut { process: \"axis-X\" } } }");
    EXPECT_FALSE(parse_scenario(cut, "here.textproto")) << "on one host there are no links";
    const auto scenario = parse_scenario(cut, "here.textproto", Asked::CONTAINER);
    ASSERT_TRUE(scenario);
    EXPECT_EQ(scenario->machine.network.interface, "eth0");
    EXPECT_THAT(outline(*scenario), HasSubstr("a container each"));
}

struct Bad {
    const char* name;
    std::string text;
    std::vector<const char*> texts;
};

class BadScenario : public testing::TestWithParam<Bad> {};

TEST_P(BadScenario, IsRefusedWithPlaceValueLimitAndRemedy) {
    const std::string errors = errors_of(GetParam().text);
    ASSERT_FALSE(errors.empty()) << "it was accepted";
    for (const char* part : GetParam().texts) { EXPECT_THAT(errors, HasSubstr(part)); }
}

INSTANTIATE_TEST_SUITE_P(
    Scenarios, BadScenario,
    testing::Values(
        Bad{"UnknownKey", whole("explode: true"), {"8:8", "explode"}},
        Bad{"KeyTwice", whole("shows: \"again\""), {"8:", "shows"}},
        Bad{"WrongKind", whole("standby: \"perhaps\""), {"8:10", "perhaps"}},
        Bad{"NoMachine", "shows: \"x\"\nstep { home {} }", {"1:1", "the machine is missing", "machine_file"}},
        Bad{"TwoMachines", whole("machine_file: \"x\""), {"8:1", "keep one"}},
        Bad{"MachineThatIsNotThere", "machine_file: \"none\" shows: \"x\"", {"1:1", "/tmp/none"}},
        Bad{"MachineThatCannotBe",
            "shows: \"x\" step { home {} }\nmachine { name: \"m\"\n  tick_ns: 5 }",
            {"3:3", "tick_ns is 5", "100 to 1000000"}},
        Bad{"NothingToShow", with_machine("step { home {} }"), {"shows is missing", "describe in one sentence"}},
        Bad{"NoStep", with_machine("shows: \"x\""), {"no step", "step { home {} }"}},
        Bad{"ContinuesWithoutStandby", whole("continues: true"), {"8:1", "standby"}},
        Bad{"EmptyStep", whole("step {}"), {"8:1", "is empty", "home, run, move, wait or act"}},
        Bad{"RunOfNothing", whole("step { run {} }"), {"8:8", "file:", "gcode:"}},
        Bad{"RunOfTwo", whole("step { run { file: \"a\" gcode: \"G4 P1\" } }"), {"8:8", "one program"}},
        Bad{"BadGcode", whole("step { run { gcode: \"G90\\nG1 X500 F600\" } }"), {"8:14", "gcode:2:", "X500", "100"}},
        Bad{"MoveBeyondTravel", whole("step { move { to: \"X=101\" } }"), {"8:15", "101", "0.000 to 100.000"}},
        Bad{"MoveNowhere", whole("step { move {} }"), {"8:8", "to: \"X=10\""}},
        Bad{"WaitForTwo", whole("step { wait { seconds: 1 phase: IDLE } }"), {"8:8", "one condition"}},
        Bad{"WaitForEver", whole("step { wait { seconds: 61 } }"), {"8:15", "seconds is 61", "0 to 60"}},
        Bad{"DuringAWait",
            whole("step { wait { seconds: 1 } during { act { kill: \"axis-X\" } } }"),
            {"8:", "during is only for home, run and move"}},
        Bad{"UnknownProcess",
            whole("step { act { kill: \"axis-Q\" } }"),
            {"8:14", "axis-Q", "coordinator, axis-X, axis-Y"}},
        Bad{"NoStandby", whole("step { act { kill: \"coordinator-2\" } }"), {"there is no process 'coordinator-2'"}},
        Bad{"ActOfNothing", whole("step { act {} }"), {"8:8", "is empty", "kill"}},
        Bad{"NoLinks", whole("step { act { cut { process: \"axis-X\" } } }"), {"8:14", "place: NAMESPACE"}},
        Bad{"LossOfAllAndMore",
            whole("place: NAMESPACE step { act { lose { percent: 101 } } }"),
            {"percent is 101", "above 0 and at most 100"}},
        Bad{"KillForATime", whole("step { act { kill: \"axis-X\" for_s: 1 } }"), {"for_s", "pause, cut and lose"}},
        Bad{"OverrideTooHigh", whole("step { act { override { feed: 201 } } }"), {"feed is 201", "10 to 200"}},
        Bad{"NoCommand", whole("step { act { command: NONE } }"), {"HOLD, RESUME"}},
        Bad{"LineOfHoming",
            whole("step { home {} during { line: 3 act { command: HOLD } } }"),
            {"8:25", "only a run has lines"}},
        Bad{"LineNought",
            whole("step { run { gcode: \"G4 P1\" } during { line: 0 act { command: HOLD } } }"),
            {"line is 0", "from 1"}},
        Bad{"PlaceOutside",
            whole("step { home {} during { passes { axis: \"X\" mm: 200 } act { command: HOLD } } }"),
            {"mm is 200", "0 to 100"}},
        Bad{"RestsTooLate",
            whole("step { home {} during { act { command: HOLD } rests_within_frames: 1001 } }"),
            {"rests_within_frames is 1001", "1 to 1000"}},
        Bad{"UnknownFault", whole("step { home {} fault: \"bad-luck\" }"), {"bad-luck", "axis-lost"}},
        Bad{"WrongClockOfOneClock", whole("wrong_clock { axis: \"X\" ppm: 10 }"), {"8:1", "time_source: NETWORK"}},
        Bad{"TwoClocksOfOneAxis",
            whole("wrong_clock { axis: \"X\" } wrong_clock { axis: \"X\" }"),
            {"8:41", "already has a clock"}},
        Bad{"ClockTooFast", whole("wrong_clock { axis: \"X\" ppm: 2000 }"), {"ppm is 2000", "-1000 to 1000"}},
        Bad{"EndOfNoAxis", whole("expect { final { axis: \"Q\" mm: 1 } }"), {"8:18", "there is no axis 'Q'", "X, Y"}},
        Bad{"EndNowhere", whole("expect { final { axis: \"X\" } }"), {"8:10", "mm is missing"}},
        Bad{"PathOfNought", whole("expect { path_within_mm: 0 }"), {"8:10", "path_within_mm is 0", "above 0"}},
        Bad{"AloneTogether", whole("expect { together: \"X\" }"), {"name at least two"}},
        Bad{"UnknownCause", whole("expect { cause { kind: \"ghosts\" } }"), {"ghosts", "process-ended"}},
        Bad{"TwoEndsOfOneAxis",
            whole(
                "expect { final { axis: \"X\" mm: 10 } final { axis: \"Y\" mm: 1 }\n  final { axis: \"X\" mm: 20 } }"),
            {"9:3", "axis X already has a final position, 10 mm", "remove one"}},
        Bad{"TheSameEndTwice",
            whole("expect { final { axis: \"X\" mm: 10 } final { axis: \"X\" mm: 10 } }"),
            {"8:37", "already has a final position"}},
        Bad{"OneAxisTwiceTogether",
            whole("expect { together: \"X\" together: \"X\" }"),
            {"8:24", "axis X is already named"}},
        Bad{"OneAxisVetoesTwice",
            whole("expect { vetoes { by: \"X\" by: \"X\" } }"),
            {"8:27", "axis X is already named"}},
        Bad{"TwoStatesOfOneAxis",
            whole("expect { axis { name: \"X\" homed: true } axis { name: \"X\" homed: false } }"),
            {"8:41", "axis X already has such a block", "combine"}},
        Bad{"StateOfNothing", whole("expect { axis { name: \"X\" } }"), {"8:10", "checks nothing", "homed"}},
        Bad{"HomedAndAbsent",
            whole("expect { axis { name: \"X\" heard: false homed: true } }"),
            {"8:40", "homed contradicts heard: false"}},
        Bad{"FaultOfAnAbsentAxis",
            whole("expect { axis { name: \"X\" heard: false fault: \"none\" } }"),
            {"8:40", "fault contradicts heard: false"}},
        Bad{"CauseOfNoProcessNamesOne",
            whole("expect { cause { kind: \"emergency-stop\" process: \"axis-X\" } }"),
            {"8:41", "emergency-stop is of no single process", "remove process"}},
        Bad{"CauseInAProcessWithoutNotes",
            whole("separate_devices: true expect { cause { kind: \"fault\" process: \"fpga-X\" } }"),
            {"8:55", "fpga-X", "coordinator, axis-X, axis-Y"}},
        Bad{"EndlessDistance", whole("expect { path_within_mm: inf }"), {"8:10", "path_within_mm is inf"}},
        Bad{"EndlessTolerance",
            whole("expect { final { axis: \"X\" mm: 1 within_mm: inf } }"),
            {"8:34", "within_mm is inf", "above 0"}},
        Bad{"LineBeyondTheProgram",
            whole("step { run { gcode: \"G4 P1\\nG4 P1\" } during { line: 99 act { command: HOLD } } }"),
            {"8:47", "line is 99", "last line that does something is 2", "1 to 2"}},
        Bad{"LineAfterTheLastThatDoesSomething",
            whole("step { run { gcode: \"G4 P1\\n(end)\\nM2\" } during { line: 3 act { command: HOLD } } }"),
            {"line is 3", "last line that does something is 1"}},
        Bad{"FaultOfAJobThatIsDone",
            whole("step { home {} fault: \"axis-lost\" }"),
            {"8:16", "fault contradicts", "DONE", "FAILED"}},
        Bad{"FaultInSilence",
            whole("step { home {} ends: SILENT fault: \"axis-lost\" }"),
            {"8:29", "SILENT", "remove fault"}},
        Bad{"EventInARefusedJob",
            whole("step { home {} during { act { command: HOLD } } ends: REFUSED }"),
            {"8:16", "REFUSED", "never happens"}},
        Bad{"WrongClockThatIsRight", whole("wrong_clock { axis: \"X\" }"), {"8:1", "not wrong", "offset_s"}},
        Bad{"TimeOfNoClockStep",
            whole("wrong_clock { axis: \"X\" ppm: 1 step_at_s: 3 }"),
            {"8:32", "step_at_s", "step_s"}},
        Bad{"NoEndOfABlock",
            whole("expect {\n  final { axis: \"X\" mm: 10 }\n"),
            {"10:1", "the text ends within expect (line 8)", "add the missing }"}},
        Bad{"NoEndOfTwoBlocks",
            whole("step {\n  run { gcode: \"}\" # }\n"),
            {"10:1", "ends within run (line 9) within step (line 8)", "add the 2 missing ends"}},
        Bad{"NoEndOfAnEarlierBlock",
            whole("step { home {}\nexpect { final { axis: \"X\" mm: 10 } }\n"),
            {"9:8", "expect", "10:1", "the text ends within step (line 8)"}},
        Bad{"BraceThatClosesNothing", whole("standby: true }"), {"8:15", "closes no block", "remove it"}},
        Bad{"NoValueAtTheEnd", whole("standby:"), {"8:9", "the end of the text"}},
        Bad{"FewerThanNoInterruptions", whole("expect { interruptions: -1 }"), {"interruptions is -1", "at least 0"}}),
    [](const auto& bad) { return std::string(bad.param.name); });

TEST(ScenarioReading, NamesMotorsWhereMotorsAreMeant) {
    EXPECT_EQ(errors_of(of_gantry("expect { vetoes { by: \"Y1\" by: \"X\" } together: \"Y1\" together: \"Y2\"\n"
                                  "axis { name: \"Y\" homed: true } axis { name: \"Y2\" homed: true } }")),
              "");
    EXPECT_THAT(errors_of(of_gantry("expect { vetoes { by: \"Y\" } }")),
                HasSubstr("there is no motor 'Y'; there are: X, Y1, Y2"));
    EXPECT_THAT(errors_of(of_gantry("expect { together: \"Y1\" together: \"Y1\" }")),
                HasSubstr("motor Y1 is already named"));
    EXPECT_THAT(errors_of(of_gantry("expect { axis { name: \"Q\" homed: true } }")),
                HasSubstr("there is no axis or motor 'Q'"));
    EXPECT_THAT(errors_of(of_gantry("expect { final { axis: \"Y1\" mm: 3 } }")), HasSubstr("there is no axis 'Y1'"));
}

TEST(ScenarioReading, ReportsAllErrorsInTheOrderOfTheText) {
    const std::string errors = errors_of(whole("step {}\nexpect { path_within_mm: -1 }\ncontinues: true"));
    EXPECT_THAT(errors, StartsWith("8:1: "));
    EXPECT_LT(errors.find("9:10: "), errors.find("10:1: "));
}

TEST(ScenarioReading, ReportsAMissingOrEmptyFile) {
    EXPECT_FALSE(load_scenario("/nowhere/at-all.textproto"));
    EXPECT_FALSE(parse_scenario("", "empty.textproto"));
}

}  // namespace
}  // namespace lockstep::scenario
