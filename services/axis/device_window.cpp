#include "services/axis/device_window.hpp"

#include <algorithm>
#include <source_location>

#include "core/check.hpp"
#include "sim_fpga/firmware/host/link_words.hpp"

namespace lockstep {
namespace {

/// Keeps what was opened if it is the window of a device that answers.
std::expected<RegisterWindow, std::string> open_board_window(const DeviceName& device, const MachineSetup& machine) {
    const std::string& board = device.place;
    auto window = RegisterWindow::open_shared(firmware::board_window_name(machine.name, board, device.number));
    if (!window) { return std::unexpected(window.error() + "; start lockstep-board --board " + board); }
    if (window->load(firmware::kAnswersWord) == 0) {
        return std::unexpected("board " + board + " does not answer" + link_remedy(device, machine));
    }
    if (window->load(registers::kMagic) == 0) {
        return std::unexpected("board " + board + " answers, but has not shown a motor " +
                               std::to_string(device.number) + "; if this lasts, it has fewer motors");
    }
    return window;
}

}  // namespace

std::expected<RegisterWindow, std::string> open_window(const DeviceName& device, const MachineSetup& machine) {
    switch (device.kind) {
        case DeviceName::Kind::Simulated: break;
        case DeviceName::Kind::Shared: return RegisterWindow::open_shared(device.place);
        case DeviceName::Kind::Mapped: return RegisterWindow::open_file(device.place);
        case DeviceName::Kind::Linked: return open_board_window(device, machine);
    }
    fail_check("a device in its axis's process has no window to open", std::source_location::current());
}

std::string link_remedy(const DeviceName& device, const MachineSetup& machine) {
    const auto found = std::ranges::find(machine.board_links, device.place, &BoardLinkConfig::name);
    const std::string link = found == machine.board_links.end() ? "no link" : found->link.text();
    return "; check the cable of board " + device.place + ", " + link + ", and its power";
}

}  // namespace lockstep
