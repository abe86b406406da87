#include "clients/lockstep/live/board_look.hpp"

#include <algorithm>
#include <cstdint>
#include <thread>

#include "services/runtime/clock.hpp"
#include "sim_fpga/firmware/host/link_words.hpp"
#include "sim_fpga/firmware/link/identify_word.hpp"

namespace lockstep {
namespace {

using namespace std::chrono_literals;
using std::chrono::nanoseconds;

constexpr nanoseconds kMostSilence = 500ms;
/// A lockstep-board that lives shows a new answer within this time.
constexpr nanoseconds kNewAnswer = 300ms;

/// The windows of a lockstep-board that lives; none if there is no such process, or its board does not answer.
std::vector<RegisterWindow> shared_windows(const MachineSetup& machine, const BoardLinkConfig& board) {
    std::vector<RegisterWindow> windows;
    for (unsigned motor = 0; motor < kMostBoardMotors; ++motor) {
        auto window = RegisterWindow::open_shared(firmware::board_window_name(machine.name, board.name, motor));
        if (!window) { break; }
        windows.push_back(std::move(*window));
    }
    if (windows.empty()) { return windows; }
    const std::uint64_t before = windows[0].load(firmware::kAnsweredWord);
    for (const auto until = monotonic_now() + kNewAnswer; monotonic_now() < until;) {
        if (windows[0].load(firmware::kAnsweredWord) != before) { return windows; }
        std::this_thread::sleep_for(1ms);
    }
    return {};
}

std::vector<RegisterWindow> own_windows() {
    std::vector<RegisterWindow> windows;
    for (unsigned motor = 0; motor < kMostBoardMotors; ++motor) { windows.push_back(RegisterWindow::in_process()); }
    return windows;
}

/// From the newest question that was answered to its answer.
double answer_ms(const RegisterWindow& window) {
    return static_cast<double>(window.load(firmware::kAnsweredWord) - window.load(firmware::kAskedWord)) * 1e-6;
}

struct Spread {
    std::uint64_t count = 0;
    double least = 0;
    double most = 0;
    double sum = 0;

    void add(double value) {
        least = count == 0 ? value : std::min(least, value);
        most = count == 0 ? value : std::max(most, value);
        sum += value;
        ++count;
    }
};

}  // namespace

BoardLook::BoardLook(const MachineSetup& machine, const BoardLinkConfig& board)
    : windows_(shared_windows(machine, board)) {
    if (!windows_.empty()) { return; }
    windows_ = own_windows();
    bridge_.emplace(board.link, windows_, kMostSilence);
}

void BoardLook::step() { bridge_ ? bridge_->step() : std::this_thread::sleep_for(1ms); }

bool BoardLook::shows_answers() const { return windows_[0].load(registers::kMagic) != 0; }

std::optional<std::string> BoardLook::await(std::chrono::milliseconds most) {
    constexpr auto kForAllMotors = 200ms;  // the first one is shown before the others
    for (const auto until = monotonic_now() + most; !shows_answers(); step()) {
        if (monotonic_now() < until) { continue; }
        return bridge_ ? bridge_->lack() : std::string("it does not answer; check its cable and its power");
    }
    for (const auto until = monotonic_now() + kForAllMotors; monotonic_now() < until;) { step(); }
    return std::nullopt;
}

proto::LinkFiguresReport BoardLook::measure(std::chrono::duration<double> time) {
    const auto begun = monotonic_now();
    Spread ms;
    std::uint64_t seen = windows_[0].load(firmware::kAnsweredWord);
    for (; monotonic_now() - begun < time; step()) {
        const std::uint64_t answered = windows_[0].load(firmware::kAnsweredWord);
        if (answered == seen) { continue; }
        seen = answered;
        ms.add(answer_ms(windows_[0]));
    }
    proto::LinkFiguresReport figures;
    figures.set_seconds(std::chrono::duration<double>(monotonic_now() - begun).count());
    figures.set_answers(ms.count);
    if (ms.count == 0) { return figures; }
    figures.set_least_ms(ms.least);
    figures.set_mean_ms(ms.sum / static_cast<double>(ms.count));
    figures.set_most_ms(ms.most);
    return figures;
}

/// The word is on its way long before this returns.
void BoardLook::identify() {
    constexpr auto kToArrive = 300ms;
    windows_[0].store(firmware::kIdentifyWord, windows_[0].load(firmware::kIdentifyWord) + 1);
    for (const auto until = monotonic_now() + kToArrive; monotonic_now() < until;) { step(); }
}

std::vector<RegisterWindow> BoardLook::motors() const {
    std::vector<RegisterWindow> shown;
    for (const RegisterWindow& window : windows_) {
        if (window.load(registers::kMagic) == 0) { break; }
        shown.push_back(window);
    }
    return shown;
}

}  // namespace lockstep
