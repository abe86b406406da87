// A look at a board behind a link: through the windows of the lockstep-board that holds it, or else over the link
// itself.
#pragma once

#include <chrono>
#include <optional>
#include <string>
#include <vector>

#include "idl/proto/report.pb.h"
#include "services/board/board_bridge.hpp"
#include "services/setup/machine_setup.hpp"
#include "sim_fpga/register_window.hpp"

namespace lockstep {

class BoardLook {
public:
    static constexpr std::chrono::seconds kPatience{2};

    BoardLook(const MachineSetup& machine, const BoardLinkConfig& board);

    /// Waits until the board answers, at most so long. Returns why it does not; nullopt if it does.
    std::optional<std::string> await(std::chrono::milliseconds most);
    /// Watches the answers of the first motor for so long. await() must have returned nullopt.
    proto::LinkFiguresReport measure(std::chrono::duration<double> time);
    /// Lets the board's light blink for ten seconds. await() must have returned nullopt.
    void identify();
    /// The windows of the board's motors, in their order: those that it has shown.
    std::vector<RegisterWindow> motors() const;
    /// Whether lockstep-board holds the link.
    bool is_held() const { return !bridge_; }

private:
    void step();
    bool shows_answers() const;

    std::vector<RegisterWindow> windows_;
    std::optional<BoardBridge> bridge_;  // over the link itself
};

}  // namespace lockstep
