#include "clients/scenario/runner/cast.hpp"

#include <signal.h>
#include <sys/wait.h>

#include <algorithm>
#include <fstream>
#include <thread>
#include <utility>

#include "clients/scenario/runner/child.hpp"
#include "services/runtime/clock.hpp"

namespace lockstep::scenario {
namespace {

using namespace std::chrono_literals;

constexpr auto kEndPatience = 4s;     // for SIGTERM to be followed
constexpr auto kStartPatience = 20s;  // for what is started to start the process
constexpr std::size_t kTailLines = 4;

std::string how(int status) {
    return WIFEXITED(status) ? "ended with code " + std::to_string(WEXITSTATUS(status))
                             : "was ended by signal " + std::to_string(WTERMSIG(status));
}

/// It can still be waited for.
bool has_ended(pid_t pid) {
    siginfo_t info{};
    return waitid(P_PID, static_cast<id_t>(pid), &info, WEXITED | WNOHANG | WNOWAIT) != 0 || info.si_pid != 0;
}

}  // namespace

Cast::Cast(const std::vector<ServiceLine>& lines, StateDirectory state, std::filesystem::path numbers)
    : state_(std::move(state)), numbers_(std::move(numbers)) {
    for (const ServiceLine& line : lines) { parts_.push_back({.line = line}); }
}

Cast::Part* Cast::find(const std::string& name) {
    const auto part = std::ranges::find_if(parts_, [&](const Part& one) { return one.line.name == name; });
    return part == parts_.end() ? nullptr : &*part;
}

std::expected<Cast::Part*, std::string> Cast::running(const std::string& name) {
    reap();
    Part* part = find(name);
    if (part == nullptr || !part->runs()) { return std::unexpected(name + " does not run"); }
    return part;
}

pid_t Cast::acting(const Part& part) const {
    if (numbers_.empty()) { return part.pid; }
    const auto deadline = monotonic_now() + kStartPatience;
    while (monotonic_now() < deadline && !has_ended(part.pid)) {
        pid_t number = 0;
        if (std::ifstream(number_file(part)) >> number && number > 0) { return number; }
        std::this_thread::sleep_for(5ms);
    }
    return 0;
}

std::filesystem::path Cast::number_file(const Part& part) const { return numbers_ / (part.line.name + ".pid"); }

void Cast::tell(const Part& part, int signal) const {
    if (const pid_t number = acting(part); number > 0) { ::kill(number, signal); }
}

/// Also one that is paused.
void Cast::tell_to_end(const Part& part, int signal) const {
    tell(part, signal);
    tell(part, SIGCONT);
}

std::expected<void, std::string> Cast::start(const std::string& name) {
    reap();
    Part* part = find(name);
    if (part == nullptr || part->runs()) { return std::unexpected(name + " runs already"); }
    if (part->is_killed) { wait_for_end(*part); }
    if (!numbers_.empty()) { std::filesystem::remove(number_file(*part)); }
    const auto pid = start_program(part->line.words, state_.log_file(name));
    if (!pid) { return std::unexpected(pid.error()); }
    part->pid = *pid;
    part->is_paused = false;
    return {};
}

std::expected<void, std::string> Cast::kill(const std::string& name) {
    const auto part = running(name);
    if (!part) { return std::unexpected(part.error()); }
    tell(**part, SIGKILL);
    (*part)->is_killed = true;
    return {};
}

std::expected<void, std::string> Cast::pause(const std::string& name) {
    const auto part = running(name);
    if (!part) { return std::unexpected(part.error()); }
    tell(**part, SIGSTOP);
    (*part)->is_paused = true;
    return {};
}

std::expected<void, std::string> Cast::unpause(const std::string& name) {
    const auto part = running(name);
    if (!part) { return std::unexpected(part.error()); }
    tell(**part, SIGCONT);
    (*part)->is_paused = false;
    return {};
}

std::expected<void, std::string> Cast::restart(const std::string& name) {
    reap();
    Part* part = find(name);
    if (part != nullptr && part->runs() && !end(*part, SIGTERM)) { end(*part, SIGKILL); }
    return start(name);
}

bool Cast::is_acting(const std::string& name) {
    const auto part = running(name);
    return part && !(*part)->is_paused;
}

void Cast::wait_for_end(Part& part) {
    waitpid(part.pid, nullptr, 0);
    part.pid = 0;
    part.is_killed = false;
}

bool Cast::end(Part& part, int signal) {
    tell_to_end(part, signal);
    const auto deadline = monotonic_now() + kEndPatience;
    while (waitpid(part.pid, nullptr, WNOHANG) == 0) {
        if (monotonic_now() > deadline) { return false; }
        std::this_thread::sleep_for(5ms);
    }
    part.pid = 0;
    return true;
}

/// All are asked before one is waited for.
void Cast::end_all() {
    reap();
    for (const Part& part : parts_) {
        if (part.runs()) { tell_to_end(part, SIGTERM); }
    }
    for (Part& part : parts_) {
        if (part.is_killed) {
            wait_for_end(part);
        } else if (part.runs() && !end(part, SIGTERM)) {
            end(part, SIGKILL);
        }
    }
}

void Cast::reap() {
    for (Part& part : parts_) {
        int status = 0;
        if (part.pid == 0 || waitpid(part.pid, &status, WNOHANG) != part.pid) { continue; }
        part.pid = 0;
        if (std::exchange(part.is_killed, false)) { continue; }
        ended_by_themselves_ += (ended_by_themselves_.empty() ? "" : "; ") + part.line.name + " " + how(status) +
                                ", and said last:\n" + tail_of(state_.log_file(part.line.name), kTailLines);
    }
}

Check Cast::ends_check() {
    reap();
    const bool none_did = ended_by_themselves_.empty();
    return check_of("no process ends by itself", none_did ? "none did" : ended_by_themselves_, "the processes' logs",
                    none_did);
}

}  // namespace lockstep::scenario
