#include "clients/scenario/stage/cast.hpp"

#include <signal.h>
#include <sys/wait.h>

#include <algorithm>
#include <thread>

#include "clients/scenario/stage/child.hpp"
#include "services/runtime/clock.hpp"

namespace lockstep::scenario {
namespace {

using namespace std::chrono_literals;

constexpr auto kEndPatience = 4s;  // for SIGTERM to be followed
constexpr std::size_t kTailLines = 4;

std::string how(int status) {
    return WIFEXITED(status) ? "ended with code " + std::to_string(WEXITSTATUS(status))
                             : "was ended by signal " + std::to_string(WTERMSIG(status));
}

/// Also one that is paused.
void tell_to_end(pid_t pid, int signal) {
    ::kill(pid, signal);
    ::kill(pid, SIGCONT);
}

}  // namespace

Cast::Cast(const std::vector<ServiceLine>& lines, StateDirectory state) : state_(std::move(state)) {
    for (const ServiceLine& line : lines) { parts_.push_back({.line = line}); }
}

Cast::Part* Cast::find(const std::string& name) {
    const auto part = std::ranges::find_if(parts_, [&](const Part& one) { return one.line.name == name; });
    return part == parts_.end() ? nullptr : &*part;
}

std::expected<Cast::Part*, std::string> Cast::running(const std::string& name) {
    reap();
    Part* part = find(name);
    if (part == nullptr || part->pid == 0) { return std::unexpected(name + " does not run"); }
    return part;
}

std::expected<void, std::string> Cast::start(const std::string& name) {
    reap();
    Part* part = find(name);
    if (part == nullptr || part->pid != 0) { return std::unexpected(name + " runs already"); }
    const auto pid = start_program(part->line.words, state_.log_file(name));
    if (!pid) { return std::unexpected(pid.error()); }
    part->pid = *pid;
    part->is_paused = false;
    return {};
}

std::expected<void, std::string> Cast::kill(const std::string& name) {
    const auto part = running(name);
    if (!part) { return std::unexpected(part.error()); }
    ::kill((*part)->pid, SIGKILL);
    waitpid((*part)->pid, nullptr, 0);
    (*part)->pid = 0;
    return {};
}

std::expected<void, std::string> Cast::pause(const std::string& name) {
    const auto part = running(name);
    if (!part) { return std::unexpected(part.error()); }
    ::kill((*part)->pid, SIGSTOP);
    (*part)->is_paused = true;
    return {};
}

std::expected<void, std::string> Cast::unpause(const std::string& name) {
    const auto part = running(name);
    if (!part) { return std::unexpected(part.error()); }
    ::kill((*part)->pid, SIGCONT);
    (*part)->is_paused = false;
    return {};
}

std::expected<void, std::string> Cast::restart(const std::string& name) {
    reap();
    Part* part = find(name);
    if (part != nullptr && part->pid != 0 && !end(*part, SIGTERM)) { end(*part, SIGKILL); }
    return start(name);
}

bool Cast::is_acting(const std::string& name) {
    const auto part = running(name);
    return part && !(*part)->is_paused;
}

bool Cast::end(Part& part, int signal) {
    tell_to_end(part.pid, signal);
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
        if (part.pid == 0) { continue; }
        tell_to_end(part.pid, SIGTERM);
    }
    for (Part& part : parts_) {
        if (part.pid != 0 && !end(part, SIGTERM)) { end(part, SIGKILL); }
    }
}

void Cast::reap() {
    for (Part& part : parts_) {
        int status = 0;
        if (part.pid == 0 || waitpid(part.pid, &status, WNOHANG) != part.pid) { continue; }
        part.pid = 0;
        ended_by_themselves_ += (ended_by_themselves_.empty() ? "" : "; ") + part.line.name + " " + how(status) +
                                ", and said last:\n" + tail_of(state_.log_file(part.line.name), kTailLines);
    }
}

Check Cast::ends_check() const {
    const bool none_did = ended_by_themselves_.empty();
    return check_of("no process ends by itself", none_did ? "none did" : ended_by_themselves_, "the processes' logs",
                    none_did);
}

}  // namespace lockstep::scenario
