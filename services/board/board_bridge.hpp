// Copies words in both directions: between the board and the windows of its motors. If the line to the board is gone,
// it opens the line again.
#pragma once

#include <chrono>
#include <cstddef>
#include <cstdint>
#include <optional>
#include <string>
#include <vector>

#include "core/device/link_name.hpp"
#include "services/board/link_line.hpp"
#include "sim_fpga/firmware/host/host_words.hpp"
#include "sim_fpga/firmware/link/link.hpp"

namespace lockstep {

class BoardBridge {
public:
    using Time = std::chrono::nanoseconds;  // of CLOCK_MONOTONIC

    /// windows: of zeros, one for each motor. patience: how long the board may be silent until it does not answer.
    BoardBridge(LinkName name, std::vector<RegisterWindow> windows, Time patience);

    /// Waits for bytes, at most for kMostWait_ms, and then exchanges what there is. Call it in a loop.
    void step();
    static constexpr int kMostWait_ms = 1;

    bool answers() const { return answers_; }
    /// Why the board does not answer. Empty if it does.
    const std::string& lack() const { return lack_; }
    std::uint32_t refused() const { return link_.refused(); }
    std::uint64_t bytes_received() const { return received_; }

private:
    static constexpr Time kOpenPeriod = std::chrono::milliseconds{200};

    bool has_line(Time now);
    void receive();
    void watch_answers(Time now);

    LinkName name_;
    Time patience_;
    firmware::HostWords words_;
    firmware::Link link_;
    std::optional<LinkLine> line_;
    std::optional<Time> tried_;   // when the line was last opened
    std::uint32_t answered_ = 0;  // the board's time of its newest answer
    Time silent_{};               // how long the board was silent while this process ran
    Time stepped_{};
    bool answers_ = false;
    std::string lack_ = "not connected yet";
    std::uint64_t received_ = 0;
};

}  // namespace lockstep
