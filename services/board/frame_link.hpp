// The link to a board with Lockstep's firmware: frames in a stream of bytes, over a serial line or TCP.
#pragma once

#include <chrono>
#include <optional>

#include "services/board/board_link.hpp"
#include "services/board/link_line.hpp"
#include "sim_fpga/firmware/host/host_words.hpp"
#include "sim_fpga/firmware/link/link.hpp"

namespace lockstep {

class FrameLink final : public BoardLink {
public:
    FrameLink(LinkName name, const std::vector<RegisterWindow>& windows);

    std::expected<void, std::string> open() override;
    bool is_open() const override { return line_.has_value(); }
    void exchange() override;
    std::uint64_t answers() const override { return answers_; }
    std::string lack() const override;
    void show(bool answers) override { words_.show_link(answers); }
    std::uint64_t refused() const override { return link_.refused(); }
    std::uint64_t bytes_received() const override { return received_; }

private:
    void receive();

    LinkName name_;
    firmware::HostWords words_;
    firmware::Link link_;
    std::optional<LinkLine> line_;
    std::uint64_t answers_ = 0;
    std::uint32_t answered_ = 0;  // the board's time of its newest answer
    std::uint64_t received_ = 0;
};

}  // namespace lockstep
