#include "tests/integration/cli/command.hpp"

#include <fcntl.h>
#include <signal.h>
#include <sys/wait.h>
#include <unistd.h>

#include <filesystem>
#include <fstream>
#include <iterator>

namespace lockstep {
namespace {

std::string text_of(const std::string& path) {
    std::ifstream file(path, std::ios::binary);
    return {std::istreambuf_iterator<char>(file), {}};
}

std::string unique_path() {
    static int number = 0;
    return testing::TempDir() + "lockstep-cli-" + std::to_string(getpid()) + "-" + std::to_string(number++);
}

void redirect(const std::string& path, int flags, int to) { dup2(open(path.c_str(), flags | O_CLOEXEC, 0644), to); }

}  // namespace

ChildProcess::ChildProcess(const std::string& program, const Words& words) : files_(unique_path()) {
    std::vector<char*> arguments{const_cast<char*>(program.c_str())};
    for (const std::string& word : words) { arguments.push_back(const_cast<char*>(word.c_str())); }
    arguments.push_back(nullptr);
    pid_ = fork();
    if (pid_ != 0) { return; }
    redirect("/dev/null", O_RDONLY, STDIN_FILENO);
    redirect(files_ + ".out", O_WRONLY | O_CREAT | O_TRUNC, STDOUT_FILENO);
    redirect(files_ + ".err", O_WRONLY | O_CREAT | O_TRUNC, STDERR_FILENO);
    execv(arguments[0], arguments.data());
    _exit(127);
}

ChildProcess::~ChildProcess() {
    if (pid_ > 0) {
        signal(SIGKILL);
        (void)wait();
    }
    std::error_code error;
    std::filesystem::remove(files_ + ".out", error);
    std::filesystem::remove(files_ + ".err", error);
}

void ChildProcess::signal(int number) const { kill(pid_, number); }

std::string ChildProcess::out() const { return text_of(files_ + ".out"); }

Ran ChildProcess::wait() {
    int status = 0;
    waitpid(pid_, &status, 0);
    pid_ = 0;
    return {WIFEXITED(status) ? WEXITSTATUS(status) : -WTERMSIG(status), out(), text_of(files_ + ".err")};
}

Ran run_lockstep(const Words& words) { return ChildProcess(LOCKSTEP_COMMAND, words).wait(); }

}  // namespace lockstep
