// A child process of a test.
#pragma once

#include <signal.h>
#include <sys/wait.h>
#include <unistd.h>

#include <string>
#include <utility>
#include <vector>

namespace lockstep {

class Child {
public:
    /// Runs a program, searched in PATH if it is only a name.
    static Child execute(std::vector<std::string> words) {
        std::vector<char*> arguments;
        for (std::string& word : words) { arguments.push_back(word.data()); }
        arguments.push_back(nullptr);
        const pid_t pid = fork();
        if (pid == 0) {
            execvp(arguments[0], arguments.data());
            _exit(127);
        }
        return Child(pid);
    }

    Child(Child&& other) noexcept : pid_(std::exchange(other.pid_, 0)) {}
    Child& operator=(Child&&) = delete;
    ~Child() {
        if (pid_ > 0) {
            signal(SIGKILL);
            wait();
        }
    }

    void signal(int number) const { kill(pid_, number); }

    /// Its exit code, or minus the signal that ended it.
    int wait() {
        int status = 0;
        waitpid(std::exchange(pid_, 0), &status, 0);
        return WIFEXITED(status) ? WEXITSTATUS(status) : -WTERMSIG(status);
    }

private:
    explicit Child(pid_t pid) : pid_(pid) {}
    pid_t pid_;
};

}  // namespace lockstep
