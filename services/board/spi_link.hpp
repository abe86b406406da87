// The link to an FPGA with the design of several motors: sim_fpga/spi over an SPI device of Linux.
#pragma once

#include <chrono>
#include <optional>

#include "services/board/board_link.hpp"
#include "services/board/spi_line.hpp"
#include "sim_fpga/spi/chip_motor.hpp"

namespace lockstep {

class SpiLink final : public BoardLink {
public:
    SpiLink(LinkName name, const std::vector<RegisterWindow>& windows);

    std::expected<void, std::string> open() override;
    bool is_open() const override { return line_.has_value(); }
    void exchange() override;
    std::uint64_t answers() const override { return answers_; }
    std::string lack() const override;
    void show(bool answers) override;
    std::uint64_t refused() const override { return repeated_ + (chip_ ? chip_->repeated() : 0); }
    std::uint64_t bytes_received() const override { return bytes_ + (chip_ ? chip_->bytes() : 0); }

private:
    using Time = std::chrono::nanoseconds;
    /// A motor, and when it is looked at next.
    struct Motor {
        spi::ChipMotor motor;
        Time due{};
    };

    bool bears_speed();
    bool exchange(Motor& motor);
    void close();

    LinkName name_;
    std::vector<Motor> motors_;
    std::optional<SpiLine> line_;
    std::optional<spi::ChipSpi> chip_;  // behind line_
    bool bears_speed_ = false;          // the design of the chip was asked
    std::uint32_t most_hz_ = 0;         // that it bears, if the link's is more
    spi::Fault fault_ = spi::Fault::None;
    std::uint64_t answers_ = 0;
    std::uint64_t repeated_ = 0;  // over lines before this one
    std::uint64_t bytes_ = 0;
};

}  // namespace lockstep
