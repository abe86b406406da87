#include "services/board/board_service.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <expected>
#include <vector>

#include "core/kinematics/motors.hpp"
#include "core/protocol/rules.hpp"
#include "services/board/board_bridge.hpp"
#include "services/documents/edit/kept_settings.hpp"
#include "services/runtime/clock.hpp"
#include "services/runtime/end_guard.hpp"
#include "services/runtime/log.hpp"
#include "services/runtime/real_time.hpp"
#include "services/runtime/service_manager.hpp"
#include "services/runtime/service_options.hpp"
#include "sim_fpga/firmware/host/link_words.hpp"

namespace lockstep {
namespace {

/// How many motors of a board the machine has: one more than the greatest number.
unsigned motors_of_board(const MachineSetup& machine, const std::string& board) {
    unsigned motors = 0;
    for (const MotorConfig& motor : motors_of(machine)) {
        if (motor.device.is_of_board(board)) { motors = std::max(motors, motor.device.number + 1); }
    }
    return motors;
}

std::expected<std::vector<RegisterWindow>, std::string> make_windows(const MachineSetup& machine,
                                                                     const std::string& board) {
    std::vector<RegisterWindow> windows;
    for (unsigned motor = 0; motor < motors_of_board(machine, board); ++motor) {
        auto window = RegisterWindow::create_shared(firmware::board_window_name(machine.name, board, motor));
        if (!window) { return std::unexpected(window.error()); }
        windows.push_back(std::move(*window));
    }
    return windows;
}

/// Logs when the board begins or ceases to answer, and every few seconds why it does not.
class BoardReport {
public:
    explicit BoardReport(const BoardLinkConfig& board) : board_(board) {}

    void look(const BoardBridge& bridge, std::chrono::nanoseconds now) {
        constexpr std::chrono::seconds kPeriod{5};
        const bool is_new = bridge.answers() != answered_;
        answered_ = bridge.answers();
        if (!is_new && (answered_ || now - reported_ < kPeriod)) { return; }
        reported_ = now;
        if (answered_) { return log_info("board {} answers over {}", board_.name, board_.link.text()); }
        log_warning("board {} does not answer over {}: {}", board_.name, board_.link.text(), bridge.lack());
    }

private:
    BoardLinkConfig board_;
    bool answered_ = false;
    std::chrono::nanoseconds reported_ = monotonic_now();
};

int run(const MachineSetup& machine, const BoardLinkConfig& board) {
    StopSignal stop;
    const EndGuard guard(stop);
    for (const std::string& line : ask_for_real_time(machine.real_time)) { log_info(line); }
    auto windows = make_windows(machine, board.name);
    if (!windows) { return end_with_failure(windows.error()); }
    const std::chrono::microseconds patience{machine.timing.slot_us * rules::silence_slots(machine.timing)};
    BoardBridge bridge(board.link, *windows, patience);
    BoardReport report(board);
    ServiceManager manager;
    manager.ready(fmt::format("board {} of machine {}", board.name, machine.name));
    log_info("board {} of machine {} is up, link {}", board.name, machine.name, board.link.text());
    while (!stop.requested()) {
        bridge.step();
        report.look(bridge, monotonic_now());
        manager.alive(monotonic_now());
    }
    manager.stopping();
    log_info("ends; {} bytes received, {} frames refused", bridge.bytes_received(), bridge.refused());
    return kServiceDone;
}

}  // namespace

int serve_board(const BoardOptions& options) {
    const auto loaded = load_machine(options.machine_file);
    if (!loaded) { return end_with_bad_input(to_text(options.machine_file, loaded.error())); }
    const MachineSetup& machine = loaded->config;
    const auto board = std::ranges::find(machine.board_links, options.board, &BoardLinkConfig::name);
    if (board == machine.board_links.end()) {
        return end_with_bad_input(options.machine_file + ": no board \"" + options.board + "\" with a link");
    }
    if (auto log = open_log({"board", board->name, options.log_file, true}); !log) {
        return end_with_bad_input(log.error());
    }
    return run(machine, *board);
}

}  // namespace lockstep
