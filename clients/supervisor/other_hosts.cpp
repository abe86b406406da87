#include "clients/supervisor/other_hosts.hpp"

#include <fcntl.h>
#include <fmt/format.h>
#include <signal.h>
#include <sys/wait.h>
#include <unistd.h>

#include <array>
#include <cerrno>
#include <cstdlib>
#include <filesystem>
#include <iterator>
#include <sstream>

#include "services/documents/placement.hpp"
#include "services/network/host_name.hpp"

namespace lockstep {
namespace {

std::vector<std::string> words_of(const std::string& text) {
    std::istringstream stream(text);
    return {std::istream_iterator<std::string>(stream), std::istream_iterator<std::string>()};
}

/// The file that the option or the environment names. Other hosts do not know the environment.
std::string named_file(const std::string& option) {
    const char* named = std::getenv("LOCKSTEP_MACHINE");
    const std::string file = !option.empty() ? option : named == nullptr ? "" : named;
    return file.empty() ? "" : std::filesystem::absolute(file).string();
}

[[noreturn]] void become(const std::vector<std::string>& words, int output) {
    dup2(open("/dev/null", O_RDONLY | O_CLOEXEC), STDIN_FILENO);
    dup2(output, STDOUT_FILENO);
    dup2(output, STDERR_FILENO);
    std::vector<char*> arguments;
    for (const std::string& word : words) { arguments.push_back(const_cast<char*>(word.c_str())); }
    arguments.push_back(nullptr);
    execvp(arguments[0], arguments.data());
    dprintf(STDERR_FILENO, "cannot execute %s\n", arguments[0]);
    _exit(127);
}

std::string all_of(int pipe) {
    std::string text;
    std::array<char, 4096> buffer{};
    for (ssize_t n = 0; (n = read(pipe, buffer.data(), buffer.size())) != 0;) {
        if (n < 0 && errno != EINTR) { break; }
        if (n > 0) { text.append(buffer.data(), static_cast<std::size_t>(n)); }
    }
    return text;
}

}  // namespace

OtherHosts::OtherHosts(const AllHosts& all, const MachineSetup& machine, const std::string& machine_file,
                       const std::vector<std::string>& verb) {
    for (const std::string& host : all.asked ? hosts_of(machine) : std::vector<std::string>{}) {
        if (same_host(host, host_name())) { continue; }
        std::vector<std::string> words = words_of(all.ssh);
        words.insert(words.end(), {host, "lockstep"});
        words.insert(words.end(), verb.begin(), verb.end());
        if (const std::string file = named_file(machine_file); !file.empty()) {
            words.insert(words.end(), {"--machine", file});
        }
        std::array<int, 2> ends{};
        if (pipe2(ends.data(), O_CLOEXEC) != 0) { continue; }
        const pid_t pid = fork();
        if (pid == 0) { become(words, ends[1]); }
        close(ends[1]);
        remotes_.push_back({host, pid, Descriptor(ends[0])});
    }
}

OtherHosts::~OtherHosts() {
    for (Remote& remote : remotes_) {
        remote.output = Descriptor();
        if (remote.pid > 0) { waitpid(remote.pid, nullptr, 0); }
    }
}

bool OtherHosts::finish(Output& output, std::size_t lines_where_well) {
    bool good = true;
    for (Remote& remote : remotes_) {
        std::istringstream lines(all_of(remote.output.get()));
        int status = 0;
        const bool ended = remote.pid > 0 && waitpid(remote.pid, &status, 0) == remote.pid;
        remote.pid = 0;
        const bool is_well = ended && WIFEXITED(status) && WEXITSTATUS(status) == 0;
        std::size_t printed = 0;
        for (std::string line; (!is_well || printed < lines_where_well) && std::getline(lines, line); ++printed) {
            output.print(remote.host + ": " + line);
        }
        if (is_well) { continue; }
        good = false;
        output.warn(
            fmt::format("{0}: lockstep failed on this host with code {1}; check that `ssh {0} lockstep status` works",
                        remote.host, ended && WIFEXITED(status) ? std::to_string(WEXITSTATUS(status)) : "unknown"));
    }
    return good;
}

}  // namespace lockstep
