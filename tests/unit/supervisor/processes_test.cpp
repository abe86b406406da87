#include <gmock/gmock.h>
#include <gtest/gtest.h>
#include <unistd.h>

#include "clients/supervisor/found_processes.hpp"
#include "clients/supervisor/process_record.hpp"
#include "clients/supervisor/restart_policy.hpp"
#include "clients/supervisor/service_lines.hpp"
#include "tests/unit/session/two_axes.hpp"

namespace lockstep {
namespace {

using namespace std::chrono_literals;
using testing::Contains;
using testing::ElementsAre;
using testing::Not;

ProcessRecord this_process() { return {"test", getpid(), *start_of(getpid())}; }

TEST(ProcessRecord, IsReadAsItWasWritten) {
    const std::vector<ProcessRecord> records{{"supervisor", 12, 3456}, {"axis-X", {}, 0}};
    EXPECT_EQ(records_from_text(to_text(records)), records);
}

TEST(ProcessRecord, ThatIsDamagedIsLeftOut) {
    EXPECT_THAT(records_from_text("axis-X\n\naxis-Y 12 x\naxis-Z 7 9\naxis-Q -1 9\n"),
                ElementsAre(ProcessRecord{"axis-Z", 7, 9}));
}

TEST(ProcessRecord, IsKnownToBeDamaged) {
    EXPECT_FALSE(is_damaged(to_text({{"supervisor", 12, 3456}, {"axis-X", {}, 0}})));
    for (const char* text : {"", "\n", "supervisor 12 3456", "supervisor 12 3456\naxis-X\n", "\x01\xff\n"}) {
        EXPECT_TRUE(is_damaged(text)) << text;
    }
}

TEST(ProcessRecord, DoesNotMatchAnotherProcessWithTheSamePid) {
    EXPECT_TRUE(is_running(this_process()));
    ProcessRecord earlier = this_process();
    --earlier.start;
    EXPECT_FALSE(is_running(earlier));
    signal_process(earlier, SIGKILL);  // must not signal this process: the test would end here
    EXPECT_TRUE(wait_until_gone({earlier}, 0ms));
    EXPECT_FALSE(wait_until_gone({this_process()}, 0ms));
}

TEST(ProcessRecord, WithoutANumberIsOfNone) {
    EXPECT_FALSE(is_running({.name = "axis-X"}));
    signal_process({.name = "axis-X"}, SIGKILL);  // 0 would mean the whole process group
    EXPECT_TRUE(wait_until_gone({{.name = "axis-X"}}, 0ms));
}

TEST(RestartPolicy, WaitsLongerAfterEachExitThenGivesUp) {
    RestartPolicy policy;
    EXPECT_EQ(policy.after_end(1s, ProcessEnd::Exit), 200ms);
    EXPECT_EQ(policy.after_end(2s, ProcessEnd::Exit), 400ms);
    EXPECT_EQ(policy.after_end(3s, ProcessEnd::Exit), 800ms);
    EXPECT_EQ(policy.after_end(4s, ProcessEnd::Exit), 1600ms);
    EXPECT_EQ(policy.after_end(5s, ProcessEnd::Exit), 3200ms);
    EXPECT_EQ(policy.after_end(6s, ProcessEnd::Exit), std::nullopt);
}

TEST(RestartPolicy, StartsAProcessThatSignalsEndAgainHoweverOften) {
    RestartPolicy policy;
    for (int i = 0; i < 1000; ++i) {
        const auto delay = policy.after_end(i * 1s, ProcessEnd::Signal);
        ASSERT_TRUE(delay);
        EXPECT_LE(*delay, 3200ms);
    }
    EXPECT_EQ(policy.after_end(1000s, ProcessEnd::Exit), 3200ms) << "the first exit after many signals";
}

TEST(RestartPolicy, ForgetsOldExits) {
    RestartPolicy policy;
    for (int i = 0; i < 5; ++i) { (void)policy.after_end(1s, ProcessEnd::Exit); }
    EXPECT_EQ(policy.after_end(1s + kRestartWindow, ProcessEnd::Exit), std::nullopt);
    EXPECT_EQ(policy.after_end(2s + kRestartWindow, ProcessEnd::Exit), 200ms);
}

std::vector<std::string> names_of(const std::vector<ServiceLine>& lines) {
    std::vector<std::string> names;
    for (const ServiceLine& line : lines) { names.push_back(line.name); }
    return names;
}

Placement all() { return {.coordinator = true, .axes = {MotorIndex{0}, MotorIndex{1}}}; }

TEST(ServiceLines, AreACoordinatorAndAnAxisEach) {
    const auto lines = service_lines(two_axes(), all(), {}, "/opt/bin", StateDirectory("mill"));
    EXPECT_THAT(names_of(lines), ElementsAre("coordinator", "axis-X", "axis-Y"));
    EXPECT_EQ(lines[1].words[0], "/opt/bin/lockstep-axis");
    EXPECT_THAT(lines[1].words, Contains(StateDirectory("mill").machine_file().string()));
}

TEST(ServiceLines, AreOnlyOfThePartsPlacedOnTheHost) {
    const auto on_a_board =
        service_lines(two_axes(), {.axes = {MotorIndex{1}}}, {}, "/opt/bin", StateDirectory("mill"));
    EXPECT_THAT(names_of(on_a_board), ElementsAre("axis-Y"));
    const auto on_the_main_host = service_lines(two_axes(), {.coordinator = true}, {}, "/opt/bin", StateDirectory("m"));
    EXPECT_THAT(names_of(on_the_main_host), ElementsAre("coordinator"));
}

TEST(ServiceLines, WithAStandbyHaveTwoCoordinatorsOfEqualRank) {
    const auto lines = service_lines(two_axes(), all(), {.standby = true}, "/opt/bin", StateDirectory("mill"));
    EXPECT_THAT(names_of(lines), ElementsAre("coordinator", "coordinator-2", "axis-X", "axis-Y"));
    for (const std::size_t i : {0, 1}) { EXPECT_THAT(lines[i].words, Contains("--standby")); }
    EXPECT_THAT(lines[0].words, Not(Contains("--second")));
    EXPECT_THAT(lines[1].words, Contains("--second")) << "it has its own keys";
}

TEST(ServiceLines, WithThePageHaveItBesideTheCoordinator) {
    const StateDirectory state("mill");
    const auto asked = service_lines(two_axes(), all(), {.web = true}, "/opt/bin", state);
    EXPECT_THAT(names_of(asked), ElementsAre("coordinator", "axis-X", "axis-Y", "web"));
    EXPECT_EQ(asked.back().words[0], "/opt/bin/lockstep-web");
    EXPECT_THAT(asked.back().words, Contains(state.page_file().string())) << "a log has no tokens";
    MachineSetup machine = two_axes();
    machine.web = WebConfig{};
    EXPECT_EQ(names_of(service_lines(machine, all(), {}, "/opt/bin", state)), names_of(asked));
    EXPECT_THAT(names_of(service_lines(machine, {.axes = {MotorIndex{1}}}, {.web = true}, "/opt/bin", state)),
                ElementsAre("axis-Y"));
}

TEST(ServiceLines, WithDevicesOfTheirOwnHaveTheDevicesFirst) {
    const auto lines = service_lines(two_axes(), all(), {.fpga = FpgaKind::Shared}, "/opt/bin", StateDirectory("mill"));
    EXPECT_THAT(names_of(lines), ElementsAre("fpga-X", "fpga-Y", "coordinator", "axis-X", "axis-Y"));
    EXPECT_EQ(lines[0].words.back(), "lockstep-mill-X");
    EXPECT_THAT(lines[3].words, Contains("shm:lockstep-mill-X"));
}

TEST(ServiceLines, HaveTheBoardOfPlacedMotorsOnceAndFirst) {
    MachineSetup machine = two_axes();
    machine.board_links = {{.name = "pico1", .link = {LinkName::Kind::Tcp, "127.0.0.1", 7001}}};
    for (unsigned n : {0U, 1U}) { machine.axes[n].device = {DeviceName::Kind::Linked, "pico1", n}; }
    const StateDirectory state("mill");
    const auto lines = service_lines(machine, all(), {}, "/opt/bin", state);
    EXPECT_THAT(names_of(lines), ElementsAre("board-pico1", "coordinator", "axis-X", "axis-Y"));
    EXPECT_EQ(lines[0].words[0], "/opt/bin/lockstep-board");
    EXPECT_EQ(service_name(lines[0].words, state.machine_file()), "board-pico1");
    EXPECT_THAT(names_of(service_lines(machine, {.axes = {MotorIndex{1}}}, {}, "/opt/bin", state)),
                ElementsAre("board-pico1", "axis-Y"));
    EXPECT_THAT(names_of(service_lines(machine, all(), {.fpga = FpgaKind::Sim}, "/opt/bin", state)),
                ElementsAre("coordinator", "axis-X", "axis-Y"));
}

}  // namespace
}  // namespace lockstep
