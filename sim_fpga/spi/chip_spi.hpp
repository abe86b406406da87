// The host's end of sim_fpga/rtl/motors/motors_spi.v: reads and writes words of the chip's motors, and repeats what was
// lost, damaged or refused.
//
// A write counts if the chip says twice that it has all words. The command before it was a read whose word arrived, so
// the number that the chip says is of this write: a lost command cannot be taken for one that was obeyed.
#pragma once

#include <cstddef>
#include <cstdint>
#include <optional>
#include <span>
#include <vector>

#include "sim_fpga/spi/spi_port.hpp"

namespace lockstep::spi {

/// What was wrong with the chip's newest answer.
enum class Fault : std::uint8_t {
    None,
    Gone,     // there is no port any more
    Silent,   // all bits were the same: nobody sends
    Foreign,  // the chip's state is not followed by its complement
    Damaged,  // words arrive with a wrong CRC, or are not accepted
    Busy,     // the chip remains busy: its ticks stand still
};

class ChipSpi {
public:
    /// A write of more words is made in parts.
    static constexpr std::size_t kMostWritten = 63;
    /// A read of more words is made in parts, because Linux exchanges 4096 bytes at most.
    static constexpr std::size_t kMostRead = 256;

    /// `port` must outlive this object.
    explicit ChipSpi(SpiPort& port) : port_(port) {}

    /// offset: in bytes, as in a RegisterWindow of the motor. Returns nullopt if this does not succeed; then see
    /// fault().
    std::optional<std::vector<std::uint64_t>> read(unsigned motor, std::size_t offset, std::size_t count);
    /// Returns false if this does not succeed; an unknown number of the words is written then.
    [[nodiscard]] bool write(unsigned motor, std::size_t offset, std::span<const std::uint64_t> words);
    /// Asks the chip to show the words of a motor, and waits until it is not busy. If the command was lost, the motor's
    /// SEQUENCE stays as it was. Returns false if the chip does not answer.
    [[nodiscard]] bool show(unsigned motor);

    Fault fault() const { return fault_; }
    /// Transactions that were repeated because of damage or loss.
    std::uint64_t repeated() const { return repeated_; }
    std::uint64_t bytes() const { return bytes_; }

private:
    struct Status {
        bool is_busy;
        unsigned words;  // written by the last command that was accepted
        bool operator==(const Status&) const = default;
    };
    static constexpr int kMostTries = 60;       // without progress
    static constexpr int kMostStatusTries = 8;  // for two equal answers
    static constexpr int kMostWaits = 4000;     // for a chip that is busy

    bool exchange(std::span<Transaction> transactions);
    std::optional<Status> settled(std::span<const Transaction> first);
    std::optional<Status> status_of(std::span<const Transaction> two);
    std::size_t read_part(unsigned motor, std::size_t offset, std::size_t count, std::vector<std::uint64_t>& to);
    std::optional<std::size_t> write_part(unsigned motor, std::size_t offset, std::span<const std::uint64_t> words);

    SpiPort& port_;
    Fault fault_ = Fault::None;
    std::uint64_t repeated_ = 0;
    std::uint64_t bytes_ = 0;
};

}  // namespace lockstep::spi
