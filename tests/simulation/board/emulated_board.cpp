#include "tests/simulation/board/emulated_board.hpp"

#include <sys/wait.h>
#include <unistd.h>

#include <array>
#include <csignal>
#include <cstring>
#include <stdexcept>
#include <utility>

namespace lockstep::testing {

class EmulatorProcess {
public:
    EmulatorProcess(const std::string& emulator, const std::string& firmware) {
        std::array<int, 2> requests{};
        std::array<int, 2> answers{};
        if (::pipe(requests.data()) != 0 || ::pipe(answers.data()) != 0) { throw std::runtime_error("no pipe"); }
        std::signal(SIGPIPE, SIG_IGN);
        process_ = ::fork();
        if (process_ == 0) {
            ::dup2(requests[0], STDIN_FILENO);
            ::dup2(answers[1], STDOUT_FILENO);
            for (const int file : {requests[0], requests[1], answers[0], answers[1]}) { ::close(file); }
            ::execlp("node", "node", emulator.c_str(), firmware.c_str(), nullptr);
            ::_exit(127);
        }
        ::close(requests[0]);
        ::close(answers[1]);
        requests_ = requests[1];
        answers_ = answers[0];
    }
    ~EmulatorProcess() {
        ::close(requests_);
        ::close(answers_);
        ::waitpid(process_, nullptr, 0);
    }
    EmulatorProcess(const EmulatorProcess&) = delete;
    EmulatorProcess& operator=(const EmulatorProcess&) = delete;

    void write(const void* bytes, std::size_t size) {
        for (const auto* at = static_cast<const char*>(bytes); size > 0;) {
            const auto done = ::write(requests_, at, size);
            if (done <= 0) { throw std::runtime_error("the emulator has ended"); }
            at += done;
            size -= static_cast<std::size_t>(done);
        }
    }
    void read(void* bytes, std::size_t size) {
        for (auto* at = static_cast<char*>(bytes); size > 0;) {
            const auto done = ::read(answers_, at, size);
            if (done <= 0) { throw std::runtime_error("the emulator has ended"); }
            at += done;
            size -= static_cast<std::size_t>(done);
        }
    }

private:
    int process_ = 0;
    int requests_ = 0;
    int answers_ = 0;
};

namespace {

/// The process of a board whose test has ended.
std::unique_ptr<EmulatorProcess>& idle_process() {
    static std::unique_ptr<EmulatorProcess> process;
    return process;
}

using Request = EmulatedBoard::Request;
using Answer = EmulatedBoard::Answer;

Answer answer_of(EmulatorProcess& process, const Request& request) {
    const auto size = [](const std::vector<std::uint8_t>& bytes) { return static_cast<std::uint32_t>(bytes.size()); };
    const std::array<std::uint32_t, 5> words{request.until_us, request.levels, static_cast<std::uint32_t>(request.plug),
                                             size(request.by_uart), size(request.by_usb)};
    process.write(words.data(), sizeof words);
    process.write(request.by_uart.data(), request.by_uart.size());
    process.write(request.by_usb.data(), request.by_usb.size());
    std::array<std::uint32_t, 5> head{};
    process.read(head.data(), sizeof head);
    Answer answer{std::vector<std::uint8_t>(head[0]),
                  std::vector<std::uint8_t>(head[1]),
                  {},
                  head[3],
                  (head[4] & 1) != 0,
                  (head[4] & 2) != 0};
    process.read(answer.by_uart.data(), answer.by_uart.size());
    process.read(answer.by_usb.data(), answer.by_usb.size());
    for (std::uint32_t n = 0; n < head[2]; ++n) {
        std::array<std::uint8_t, 10> edge{};
        process.read(edge.data(), edge.size());
        double cycle = 0;
        std::memcpy(&cycle, edge.data(), sizeof cycle);
        answer.edges.push_back({cycle, edge[8], edge[9] != 0});
    }
    return answer;
}

}  // namespace

EmulatedBoard::EmulatedBoard(const std::string& emulator, const std::string& firmware)
    : process_(idle_process() ? std::move(idle_process()) : std::make_unique<EmulatorProcess>(emulator, firmware)) {
    (void)run({.until_us = 0});
}

EmulatedBoard::~EmulatedBoard() {
    if (process_) { idle_process() = std::move(process_); }
}

Answer EmulatedBoard::run(const Request& request) {
    if (!process_) { throw std::runtime_error("the emulator has ended"); }
    try {
        return answer_of(*process_, request);
    } catch (const std::runtime_error&) {
        process_ = nullptr;
        throw;
    }
}

}  // namespace lockstep::testing
