#include "clients/scenario/runner/child_process.hpp"

#include <fcntl.h>
#include <fmt/format.h>
#include <spawn.h>
#include <sys/mman.h>
#include <sys/wait.h>
#include <unistd.h>

#include <cstring>
#include <fstream>
#include <iterator>
#include <sstream>

#include "clients/supervisor/state_directory.hpp"
#include "services/files/descriptor.hpp"

namespace lockstep::scenario {

CommandLine split_words(const std::string& text) {
    std::istringstream stream(text);
    return {std::istream_iterator<std::string>(stream), std::istream_iterator<std::string>()};
}

std::expected<pid_t, std::string> start_program(const CommandLine& words, const std::filesystem::path& log) {
    posix_spawn_file_actions_t files;
    posix_spawn_file_actions_init(&files);
    posix_spawn_file_actions_addopen(&files, STDIN_FILENO, "/dev/null", O_RDONLY, 0);
    posix_spawn_file_actions_addopen(&files, STDOUT_FILENO, log.c_str(), O_WRONLY | O_CREAT | O_APPEND, 0666);
    posix_spawn_file_actions_adddup2(&files, STDOUT_FILENO, STDERR_FILENO);
    std::vector<char*> arguments;
    for (const std::string& word : words) { arguments.push_back(const_cast<char*>(word.c_str())); }
    arguments.push_back(nullptr);
    pid_t pid = 0;
    const int error = posix_spawnp(&pid, arguments[0], &files, nullptr, arguments.data(), environ);
    posix_spawn_file_actions_destroy(&files);
    if (error == 0) { return pid; }
    return std::unexpected(fmt::format(
        "cannot start {}: {}; check that it is installed: deploy/install-dependencies installs what is needed",
        words[0], std::strerror(error)));
}

std::expected<void, std::string> run_program(const CommandLine& words, const std::filesystem::path& log) {
    const auto pid = start_program(words, log);
    if (!pid) { return std::unexpected(pid.error()); }
    int status = 0;
    waitpid(*pid, &status, 0);
    if (WIFEXITED(status) && WEXITSTATUS(status) == 0) { return {}; }
    return std::unexpected(fmt::format("{}: failed; its output:\n{}", fmt::join(words, " "), tail_of(log, 3)));
}

std::expected<std::string, std::string> output_of_program(const CommandLine& words) {
    const Descriptor memory(memfd_create("output", MFD_CLOEXEC));
    const std::filesystem::path log = fmt::format("/proc/self/fd/{}", memory.get());
    const auto ran = run_program(words, log);
    std::ifstream file(log);
    std::string output{std::istreambuf_iterator<char>(file), {}};
    if (!ran) { return std::unexpected(ran.error()); }
    return output;
}

}  // namespace lockstep::scenario
