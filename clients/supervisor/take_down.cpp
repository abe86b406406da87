#include "clients/supervisor/take_down.hpp"

#include <signal.h>

#include <algorithm>

namespace lockstep {
namespace {

using namespace std::chrono_literals;

constexpr auto kSupervisorPatience = 10s;  // longer than it waits for its own children
constexpr auto kPatience = 3s;
constexpr int kMaxRounds = 3;  // a supervisor may have started one more as it was ended

void signal_all(const std::vector<ProcessRecord>& processes, int signal) {
    for (const ProcessRecord& process : processes) { signal_process(process, signal); }
}

void end_processes(const std::vector<ProcessRecord>& processes) {
    const auto supervisor = std::ranges::find(processes, kSupervisor, &ProcessRecord::name);
    if (supervisor != processes.end()) {
        signal_process(*supervisor, SIGTERM);
        if (wait_until_gone(processes, kSupervisorPatience)) { return; }
    }
    signal_all(processes, SIGTERM);
    if (wait_until_gone(processes, kPatience)) { return; }
    signal_all(processes, SIGKILL);
    (void)wait_until_gone(processes, kPatience);
}

}  // namespace

TakenDown take_down(const StateDirectory& state, const std::optional<ProcessRecord>& also) {
    TakenDown taken;
    for (int round = 0; round < kMaxRounds; ++round) {
        std::vector<ProcessRecord> processes = state.running();
        if (also && is_running(*also) && std::ranges::find(processes, *also) == processes.end()) {
            processes.push_back(*also);
        }
        if (processes.empty()) { break; }
        end_processes(processes);
        for (const ProcessRecord& process : processes) {
            if (!is_running(process)) { taken.ended.push_back(process.name); }
        }
    }
    for (const ProcessRecord& process : state.running()) { taken.left.push_back(process.name); }
    if (taken.left.empty()) { state.forget_processes(); }
    return taken;
}

}  // namespace lockstep
