#include "tests/simulation/board/emulated_board.hpp"

#include <sys/wait.h>
#include <unistd.h>

#include <array>
#include <csignal>
#include <cstring>
#include <stdexcept>

namespace lockstep::testing {

EmulatedBoard::EmulatedBoard(const std::string& emulator, const std::string& firmware) {
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

EmulatedBoard::~EmulatedBoard() {
    ::close(requests_);
    ::close(answers_);
    ::waitpid(process_, nullptr, 0);
}

EmulatedBoard::Answer EmulatedBoard::run(std::uint32_t until_us, std::uint32_t levels,
                                         const std::vector<std::uint8_t>& bytes) {
    const std::array<std::uint32_t, 3> request{until_us, levels, static_cast<std::uint32_t>(bytes.size())};
    write(request.data(), sizeof request);
    write(bytes.data(), bytes.size());
    std::array<std::uint32_t, 3> head{};
    read(head.data(), sizeof head);
    Answer answer{std::vector<std::uint8_t>(head[0]), {}, head[2]};
    read(answer.sent.data(), answer.sent.size());
    for (std::uint32_t n = 0; n < head[1]; ++n) {
        std::array<std::uint8_t, 10> edge{};
        read(edge.data(), edge.size());
        double cycle = 0;
        std::memcpy(&cycle, edge.data(), sizeof cycle);
        answer.edges.push_back({cycle, edge[8], edge[9] != 0});
    }
    return answer;
}

void EmulatedBoard::write(const void* bytes, std::size_t size) {
    for (const auto* at = static_cast<const char*>(bytes); size > 0;) {
        const auto done = ::write(requests_, at, size);
        if (done <= 0) { throw std::runtime_error("the emulator has ended"); }
        at += done;
        size -= static_cast<std::size_t>(done);
    }
}

void EmulatedBoard::read(void* bytes, std::size_t size) {
    for (auto* at = static_cast<char*>(bytes); size > 0;) {
        const auto done = ::read(answers_, at, size);
        if (done <= 0) { throw std::runtime_error("the emulator has ended"); }
        at += done;
        size -= static_cast<std::size_t>(done);
    }
}

}  // namespace lockstep::testing
