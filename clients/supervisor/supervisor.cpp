#include "clients/supervisor/supervisor.hpp"

#include <fcntl.h>
#include <fmt/format.h>
#include <signal.h>
#include <sys/prctl.h>
#include <sys/wait.h>
#include <unistd.h>

#include <algorithm>

#include "services/runtime/clock.hpp"
#include "services/runtime/log.hpp"

namespace lockstep {
namespace {

using namespace std::chrono_literals;
using std::chrono::milliseconds;
using std::chrono::nanoseconds;

constexpr milliseconds kEndPatience = 4s;  // for the reaction to SIGTERM
constexpr std::size_t kAtOnce = 16;        // processes that start together...
constexpr milliseconds kApart = 150ms;     // ...and the others one by one: each start causes discovery traffic
constexpr int kCannotExecute = 127;        // as in shells
constexpr int kBadInput = 2;               // exit code of a service; another start would end in the same way

sigset_t handled_signals() {
    sigset_t set;
    sigemptyset(&set);
    for (const int signal : {SIGCHLD, SIGTERM, SIGINT, SIGHUP}) { sigaddset(&set, signal); }
    return set;
}

/// Runs in the child and never returns. The log's file also gets the output from before the program opens its log.
[[noreturn]] void become(const ServiceLine& line, const std::filesystem::path& log, pid_t parent) {
    prctl(PR_SET_PDEATHSIG, SIGTERM);
    if (getppid() != parent) { _exit(0); }  // the parent died before prctl took effect
    const sigset_t set = handled_signals();
    sigprocmask(SIG_UNBLOCK, &set, nullptr);
    const int file = open(log.c_str(), O_WRONLY | O_CREAT | O_APPEND | O_CLOEXEC, 0644);
    dup2(open("/dev/null", O_RDONLY | O_CLOEXEC), STDIN_FILENO);
    dup2(file, STDOUT_FILENO);
    dup2(file, STDERR_FILENO);
    std::vector<char*> words;
    for (const std::string& word : line.words) { words.push_back(const_cast<char*>(word.c_str())); }
    words.push_back(nullptr);
    execv(words[0], words.data());
    dprintf(STDERR_FILENO, "cannot execute %s\n", words[0]);
    _exit(kCannotExecute);
}

bool is_hopeless(int status) {
    return WIFEXITED(status) && (WEXITSTATUS(status) == kCannotExecute || WEXITSTATUS(status) == kBadInput);
}

}  // namespace

Supervisor::Supervisor(const StateDirectory& state, const std::vector<ServiceLine>& lines) : state_(state) {
    const nanoseconds begin = monotonic_now();
    for (std::size_t i = 0; i < lines.size(); ++i) {
        const std::size_t later = i < kAtOnce ? 0 : i - kAtOnce + 1;
        services_.push_back({.line = lines[i], .start_at = begin + kApart * later});
    }
}

void Supervisor::run() {
    const sigset_t set = handled_signals();
    sigprocmask(SIG_BLOCK, &set, nullptr);
    for (;;) {
        start_due();
        const int signal = wait_for_signal();
        if (signal == SIGTERM || signal == SIGINT) { break; }
        reap();
    }
    end_all();
    state_.forget_processes();
}

void Supervisor::start_due() {
    bool started = false;
    for (Service& service : services_) {
        if (!service.start_at || *service.start_at > monotonic_now()) { continue; }
        start(service);
        started = true;
    }
    if (started) { record(); }
}

void Supervisor::start(Service& service) {
    service.start_at.reset();
    const pid_t self = getpid();
    const pid_t pid = fork();
    if (pid == 0) { become(service.line, state_.log_file(service.line.name), self); }
    if (pid < 0) {
        log_error("cannot start " + service.line.name + ", because the host allows no more processes; tries again");
        service.start_at = monotonic_now() + 1s;
        return;
    }
    service.process = ProcessRecord{service.line.name, pid, start_of(pid).value_or(0)};
    log_info("started {}, process {}", service.line.name, pid);
}

void Supervisor::reap() {
    int status = 0;
    for (pid_t pid = waitpid(-1, &status, WNOHANG); pid > 0; pid = waitpid(-1, &status, WNOHANG)) {
        for (Service& service : services_) {
            if (service.process && service.process->pid == pid) { ended(service, status); }
        }
    }
    record();
}

void Supervisor::ended(Service& service, int status) {
    service.process.reset();
    const std::string what = service.line.name + " " + end_text(status);
    if (!is_hopeless(status)) {
        const ProcessEnd end = WIFSIGNALED(status) ? ProcessEnd::Signal : ProcessEnd::Exit;
        if (const auto delay = service.policy.after_end(monotonic_now(), end)) {
            service.start_at = monotonic_now() + *delay;
            return log_warning("{}; starts again in {} ms", what, delay->count());
        }
    }
    log_error(what + "; it is not started again: see " + state_.log_file(service.line.name).string());
}

int Supervisor::wait_for_signal() const {
    const sigset_t set = handled_signals();
    std::optional<nanoseconds> due;
    for (const Service& service : services_) {
        if (service.start_at) { due = std::min(due.value_or(*service.start_at), *service.start_at); }
    }
    if (!due) { return sigwaitinfo(&set, nullptr); }
    const timespec time = to_timespec(std::max(*due - monotonic_now(), nanoseconds{0}));
    return std::max(0, sigtimedwait(&set, nullptr, &time));
}

void Supervisor::end_all() {
    log_info("ending all processes");
    signal_all(SIGTERM);
    if (reap_all(kEndPatience)) { return; }
    log_warning("some processes did not end on SIGTERM; killing them");
    signal_all(SIGKILL);
    (void)reap_all(kEndPatience);
}

void Supervisor::signal_all(int signal) const {
    for (const Service& service : services_) {
        if (service.process) {
            kill(*service.process->pid, signal);
        }  // children that are not reaped keep their numbers
    }
}

bool Supervisor::reap_all(milliseconds time) {
    const nanoseconds deadline = monotonic_now() + time;
    const auto running = [](const Service& service) { return service.process.has_value(); };
    sigset_t child;
    sigemptyset(&child);
    sigaddset(&child, SIGCHLD);
    for (;;) {
        for (Service& service : services_) {
            if (service.process && waitpid(*service.process->pid, nullptr, WNOHANG) != 0) { service.process.reset(); }
        }
        if (std::ranges::none_of(services_, running)) { return true; }
        if (monotonic_now() >= deadline) { return false; }
        const timespec left = to_timespec(deadline - monotonic_now());
        sigtimedwait(&child, nullptr, &left);
    }
}

void Supervisor::record() const {
    std::vector<ProcessRecord> records{{kSupervisor, getpid(), start_of(getpid()).value_or(0)}};
    for (const Service& service : services_) {
        if (service.process) { records.push_back(*service.process); }
        if (!service.process && !service.start_at) { records.push_back({.name = service.line.name}); }
    }
    state_.record(records);
}

}  // namespace lockstep
