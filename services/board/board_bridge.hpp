// Copies words in both directions: between the board and the windows of its motors. If the line to the board is gone,
// it opens the line again.
#pragma once

#include <chrono>
#include <cstdint>
#include <memory>
#include <optional>
#include <string>
#include <vector>

#include "services/board/board_link.hpp"

namespace lockstep {

class BoardBridge {
public:
    using Time = std::chrono::nanoseconds;  // of CLOCK_MONOTONIC

    /// windows: of zeros, one for each motor. patience: how long the board may be silent until it does not answer.
    BoardBridge(const LinkName& name, const std::vector<RegisterWindow>& windows, Time patience);

    /// As BoardLink::exchange(). Call it in a loop.
    void step();

    bool answers() const { return answers_; }
    /// Why the board does not answer. Empty if it does.
    const std::string& lack() const { return lack_; }
    std::uint64_t refused() const { return link_->refused(); }
    std::uint64_t bytes_received() const { return link_->bytes_received(); }

private:
    static constexpr Time kOpenPeriod = std::chrono::milliseconds{200};

    bool has_line(Time now);
    void watch_answers(Time now);

    Time patience_;
    std::unique_ptr<BoardLink> link_;
    std::optional<Time> tried_;   // when the line was last opened
    std::uint64_t answered_ = 0;  // answers so far
    Time silent_{};               // how long the board was silent while this process ran
    Time stepped_{};
    bool answers_ = false;
    std::string lack_ = "not connected yet";
};

}  // namespace lockstep
