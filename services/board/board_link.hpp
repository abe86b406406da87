// A way to a board, over which words are copied in both directions: between the board and the windows of its motors.
#pragma once

#include <cstdint>
#include <expected>
#include <memory>
#include <string>
#include <vector>

#include "core/device/link_name.hpp"
#include "sim_fpga/register_window.hpp"

namespace lockstep {

class BoardLink {
public:
    /// windows: of zeros, one for each motor.
    static std::unique_ptr<BoardLink> create(const LinkName& name, const std::vector<RegisterWindow>& windows);
    virtual ~BoardLink() = default;

    /// Error: why the line cannot be opened, and the remedy.
    virtual std::expected<void, std::string> open() = 0;
    virtual bool is_open() const = 0;
    /// The line is open. Waits a millisecond at most, or for as long as the line takes to carry what there is. Closes
    /// the line if it is gone.
    virtual void exchange() = 0;
    /// How many times the board has answered.
    virtual std::uint64_t answers() const = 0;
    /// Why a board does not answer over the open line, and the remedy.
    virtual std::string lack() const = 0;
    /// Tells the motors' processes whether the board answers.
    virtual void show(bool answers) = 0;
    /// What came damaged.
    virtual std::uint64_t refused() const = 0;
    virtual std::uint64_t bytes_received() const = 0;

protected:
    BoardLink() = default;
    BoardLink(const BoardLink&) = default;
    BoardLink& operator=(const BoardLink&) = default;
};

}  // namespace lockstep
