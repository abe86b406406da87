#include "clients/scenario/runner/process_set.hpp"

#include <fmt/format.h>
#include <signal.h>
#include <sys/wait.h>

#include <algorithm>
#include <fstream>
#include <thread>
#include <utility>

#include "clients/scenario/runner/child_process.hpp"
#include "clients/supervisor/process_record.hpp"
#include "services/runtime/clock.hpp"

namespace lockstep::scenario {
namespace {

using namespace std::chrono_literals;

constexpr auto kEndPatience = 4s;            // after SIGTERM
constexpr auto kProcessStartPatience = 20s;  // for the started program to start the process
constexpr std::size_t kTailLines = 4;

/// Does not reap the process.
bool has_ended(pid_t pid) {
    siginfo_t info{};
    return waitid(P_PID, static_cast<id_t>(pid), &info, WEXITED | WNOHANG | WNOWAIT) != 0 || info.si_pid != 0;
}

}  // namespace

ProcessSet::ProcessSet(const std::vector<ServiceLine>& lines, StateDirectory state, std::filesystem::path pid_folder)
    : state_(std::move(state)), pid_folder_(std::move(pid_folder)) {
    for (const ServiceLine& line : lines) { processes_.push_back({.line = line}); }
}

ProcessSet::Process* ProcessSet::find(const std::string& name) {
    const auto process = std::ranges::find_if(processes_, [&](const Process& one) { return one.line.name == name; });
    return process == processes_.end() ? nullptr : &*process;
}

std::expected<ProcessSet::Process*, std::string> ProcessSet::running(const std::string& name) {
    reap();
    Process* process = find(name);
    if (process == nullptr || !process->runs()) { return std::unexpected(name + " does not run"); }
    return process;
}

std::optional<pid_t> ProcessSet::pid_of(const Process& process) const {
    if (pid_folder_.empty()) { return process.pid; }
    const auto deadline = monotonic_now() + kProcessStartPatience;
    while (monotonic_now() < deadline && !has_ended(*process.pid)) {
        pid_t pid = 0;
        if (std::ifstream(pid_file(process)) >> pid && pid > 0) { return pid; }
        std::this_thread::sleep_for(5ms);
    }
    return std::nullopt;
}

std::filesystem::path ProcessSet::pid_file(const Process& process) const {
    return pid_folder_ / (process.line.name + ".pid");
}

void ProcessSet::send(const Process& process, int signal) const {
    if (const auto pid = pid_of(process)) { ::kill(*pid, signal); }
}

/// SIGCONT lets a paused process handle the signal.
void ProcessSet::signal_end(const Process& process, int signal) const {
    send(process, signal);
    send(process, SIGCONT);
}

std::expected<void, std::string> ProcessSet::start(const std::string& name) {
    reap();
    Process* process = find(name);
    if (process == nullptr || process->runs()) { return std::unexpected(name + " runs already"); }
    if (process->is_killed) { wait_for_end(*process); }
    if (!pid_folder_.empty()) { std::filesystem::remove(pid_file(*process)); }
    const auto pid = start_program(process->line.words, state_.log_file(name));
    if (!pid) { return std::unexpected(pid.error()); }
    process->pid = *pid;
    process->is_paused = false;
    return {};
}

std::expected<void, std::string> ProcessSet::kill(const std::string& name) {
    const auto process = running(name);
    if (!process) { return std::unexpected(process.error()); }
    send(**process, SIGKILL);
    (*process)->is_killed = true;
    return {};
}

std::expected<void, std::string> ProcessSet::pause(const std::string& name) {
    const auto process = running(name);
    if (!process) { return std::unexpected(process.error()); }
    send(**process, SIGSTOP);
    (*process)->is_paused = true;
    return {};
}

std::expected<void, std::string> ProcessSet::unpause(const std::string& name) {
    const auto process = running(name);
    if (!process) { return std::unexpected(process.error()); }
    send(**process, SIGCONT);
    (*process)->is_paused = false;
    return {};
}

std::expected<void, std::string> ProcessSet::restart(const std::string& name) {
    reap();
    Process* process = find(name);
    if (process != nullptr && process->runs() && !end(*process, SIGTERM)) { end(*process, SIGKILL); }
    return start(name);
}

bool ProcessSet::is_active(const std::string& name) {
    const auto process = running(name);
    return process && !(*process)->is_paused;
}

void ProcessSet::wait_for_end(Process& process) {
    waitpid(*process.pid, nullptr, 0);
    process.pid.reset();
    process.is_killed = false;
}

bool ProcessSet::end(Process& process, int signal) {
    signal_end(process, signal);
    const auto deadline = monotonic_now() + kEndPatience;
    while (waitpid(*process.pid, nullptr, WNOHANG) == 0) {
        if (monotonic_now() > deadline) { return false; }
        std::this_thread::sleep_for(5ms);
    }
    process.pid.reset();
    return true;
}

/// Signals all before waiting for any.
void ProcessSet::end_all() {
    reap();
    for (const Process& process : processes_) {
        if (process.runs()) { signal_end(process, SIGTERM); }
    }
    for (Process& process : processes_) {
        if (process.is_killed) {
            wait_for_end(process);
        } else if (process.runs() && !end(process, SIGTERM)) {
            end(process, SIGKILL);
        }
    }
}

void ProcessSet::reap() {
    for (Process& process : processes_) {
        int status = 0;
        if (!process.pid || waitpid(*process.pid, &status, WNOHANG) != *process.pid) { continue; }
        process.pid.reset();
        if (std::exchange(process.is_killed, false)) { continue; }
        unexpected_exits_ += (unexpected_exits_.empty() ? "" : "; ") + process.line.name + " " + end_text(status) +
                             ", last output:\n" + tail_of(state_.log_file(process.line.name), kTailLines);
    }
}

Check ProcessSet::exit_check() {
    reap();
    const bool none_did = unexpected_exits_.empty();
    return check_of("no process ends unexpectedly", none_did ? "none ended" : unexpected_exits_, "the processes' logs",
                    none_did);
}

}  // namespace lockstep::scenario
