#include "tests/integration/cli/own_machine.hpp"

#include <fcntl.h>
#include <signal.h>
#include <sys/wait.h>
#include <unistd.h>

#include <cstdlib>
#include <fstream>

#include "services/documents/machine_file.hpp"
#include "tests/integration/wire/eventually.hpp"
#include "tests/integration/wire/own_network.hpp"

namespace lockstep {
namespace {

AxisConfig quick_axis(const char* name, double min_mm, double max_mm) {
    return {.name = name,
            .steps_per_mm = 80,
            .start_velocity_mm_s = 10,
            .max_velocity_mm_s = 150,
            .max_accel_mm_s2 = 1500,
            .max_decel_mm_s2 = 1500,
            .position_min_mm = min_mm,
            .position_max_mm = max_mm,
            .homing = {.search_velocity_mm_s = 10,
                       .latch_velocity_mm_s = 5,
                       .pulloff_mm = 0.5,
                       .switch_position_mm = min_mm - 1,
                       .park_mm = min_mm + 1},
            .plant = {.start_position_mm = min_mm + 1,
                      .travel_margin_mm = 2,
                      .max_torque_accel_mm_s2 = 2250,
                      .max_jump_mm_s = 15}};
}

}  // namespace

void OwnMachine::SetUp() {
    name_ = "cli-" + std::to_string(getpid());
    folder_ = std::filesystem::path(testing::TempDir()) / ("lockstep-" + name_);
    std::filesystem::create_directories(folder_);
    const NetworkConfig network = own_network();
    lcm_url_ = network.lcm_url;
    MachineSetup machine;
    machine.name = name_;
    machine.timing.slot_us = 20'000;  // a busy host may stall its processes for 200 ms
    machine.network = network;
    machine.axes = {quick_axis("X", 0, 200), quick_axis("Y", -50, 50)};
    machine.axes[0].method = StepMethod::Spielauer;  // the method of X's homing and own moves
    configure(machine);
    file_ = write("machine.textproto", machine_text(machine));
    setenv("LOCKSTEP_STATE", (folder_ / "state").c_str(), 1);
    setenv("LOCKSTEP_MACHINE", file_.c_str(), 1);
    start_guard();
}

/// The guard takes the machine down when the pipe closes. Any end of the test closes it.
void OwnMachine::start_guard() {
    int ends[2] = {};
    ASSERT_EQ(pipe2(ends, O_CLOEXEC), 0);
    guard_pipe_ = ends[1];
    guard_ = fork();
    if (guard_ != 0) {
        close(ends[0]);
        return;
    }
    close(ends[1]);
    char nothing = 0;
    while (read(ends[0], &nothing, 1) > 0) {}
    dup2(open("/dev/null", O_WRONLY), STDOUT_FILENO);
    execl(LOCKSTEP_COMMAND, "lockstep", "down", static_cast<char*>(nullptr));
    _exit(127);
}

void OwnMachine::TearDown() {
    if (HasFailure()) {
        for (const char* log : {"supervisor", "coordinator", "coordinator-2", "axis-X", "axis-Y", "web"}) {
            std::cerr << log << ":\n" << tail_of(state().log_file(log), 20);
        }
    }
    close(guard_pipe_);
    int status = 0;
    waitpid(guard_, &status, 0);
    EXPECT_EQ(status, 0);
    EXPECT_TRUE(state().running().empty());
    std::filesystem::remove_all(folder_);
}

std::string OwnMachine::write(const std::string& name, const std::string& text) const {
    const std::filesystem::path path = folder_ / name;
    std::ofstream(path) << text;
    return path.string();
}

void OwnMachine::bring_up(const Words& more) const {
    Words words{"up"};
    words.insert(words.end(), more.begin(), more.end());
    const Ran up = run_lockstep(words);
    ASSERT_EQ(up.code, 0) << up.out << up.err;
}

void OwnMachine::bring_up_and_home() const {
    bring_up();
    const Ran home = run_lockstep({"home"});
    ASSERT_EQ(home.code, 0) << home.out << home.err;
}

void OwnMachine::record() {
    log_ = write("run.lcm", "");
    logger_.emplace("/usr/bin/lcm-logger", Words{"--force", "--quiet", "--lcm-url=" + lcm_url_, log_});
}

/// lcm-logger drops messages while it stalls itself: the processes' own logs have them. A killed process has not
/// written its last messages: lcm-logger has received them.
void OwnMachine::expect_verified() {
    const Ran verified = verify_until([](const Ran& ran) { return ran.code == 0; });
    EXPECT_EQ(verified.code, 0) << verified.out << verified.err;
}

void OwnMachine::expect_as_planned() {
    const auto is_as_planned = [](const Ran& ran) {
        return ran.out.starts_with("exact: ") || ran.out.starts_with("unknown: ");
    };
    const Ran verified = verify_until(is_as_planned);
    EXPECT_TRUE(is_as_planned(verified)) << verified.out << verified.err;
}

Ran OwnMachine::verify_until(const std::function<bool(const Ran&)>& is_enough) {
    const std::string whole = (folder_ / "whole.lcm").string();
    const auto verify_all = [&] {
        const Ran merged = run_lockstep({"log", "merge", "--force", whole, log_, state().path() / "record"});
        const Ran verified = run_lockstep({"verify", whole});
        return Ran{verified.code, verified.out, verified.err + merged.out + merged.err};
    };
    (void)eventually([&] { return is_enough(verify_all()); });
    logger_->signal(SIGTERM);
    (void)logger_->wait();
    return verify_all();
}

proto::StatusReport OwnMachine::status() const {
    return run_lockstep({"status", "--json"}).json<proto::StatusReport>();
}

bool OwnMachine::becomes(const std::string& phase) const {
    return eventually([&] { return status().phase() == phase; });
}

pid_t OwnMachine::process(const std::string& name) const {
    for (const ProcessRecord& record : state().running()) {
        if (record.name == name) { return *record.pid; }
    }
    return 0;
}

}  // namespace lockstep
