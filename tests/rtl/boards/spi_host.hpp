// The host's end of sim_fpga/rtl/motors/motors_spi.v, at the pins.
#pragma once

#include <cstddef>
#include <cstdint>
#include <functional>
#include <optional>
#include <utility>
#include <vector>

namespace lockstep::rtl {

class SpiHost {
public:
    /// What the chip sends while it gets a command.
    struct Status {
        bool is_busy;
        bool is_refused;
        unsigned words;  // written by the last command
        bool operator==(const Status&) const = default;
    };
    enum class Kind : std::uint64_t { kRead = 1, kWrite = 2, kShow = 3 };

    /// transfer(select, bit): gives the chip a bit while it is selected, or deselects it, and returns the chip's bit.
    explicit SpiHost(std::function<bool(bool select, bool bit)> transfer) : transfer_(std::move(transfer)) {}

    /// The bit of the next transaction that the line turns round; the first one is 0.
    void damage(std::size_t bit) { damaged_ = bit; }
    std::optional<Status> status() {
        begin();
        const std::uint64_t bits = exchange(0, 16);
        end();
        if ((bits >> 8) != (~bits & 0xFF)) { return std::nullopt; }
        return Status{(bits >> 15) != 0, (bits >> 14 & 1) != 0, static_cast<unsigned>(bits >> 8 & 0x3F)};
    }
    /// The status when the chip is no longer busy.
    Status settled() {
        for (;;) {
            if (const auto now = status(); now && !now->is_busy) { return *now; }
        }
    }
    /// Returns once the words are shown.
    void show(std::size_t motor) {
        begin_command(Kind::kShow, motor, 0);
        end();
        (void)settled();
    }
    /// Begins to write. offset: in bytes, as in a RegisterWindow.
    void write(std::size_t motor, std::size_t offset, const std::vector<std::uint64_t>& words) {
        begin_command(Kind::kWrite, motor, offset);
        for (const std::uint64_t word : words) { send(word, 64); }
        end();
    }
    /// Nothing if a CRC is wrong.
    std::optional<std::vector<std::uint64_t>> read(std::size_t motor, std::size_t offset, std::size_t count) {
        begin_command(Kind::kRead, motor, offset);
        (void)exchange(0, 8);
        std::vector<std::uint64_t> words;
        while (words.size() < count) {
            const std::uint64_t word = exchange(0, 64);
            if (exchange(0, 16) != crc_of(word, 64)) { break; }
            words.push_back(word);
        }
        end();
        if (words.size() < count) { return std::nullopt; }
        return words;
    }
    void begin_command(Kind kind, std::size_t motor, std::size_t offset) {
        begin();
        send(static_cast<std::uint64_t>(kind) << 22 | motor << 17 | offset / 8, 24);
    }
    void end() { (void)transfer_(false, false); }
    static std::uint16_t crc_of(std::uint64_t word, unsigned bits) {
        unsigned crc = 0xFFFF;
        while (bits-- > 0) { crc = crc << 1 ^ (((crc >> 15 ^ word >> bits) & 1) != 0 ? 0x1021U : 0U); }
        return static_cast<std::uint16_t>(crc);
    }

private:
    static constexpr std::size_t kNone = ~std::size_t{0};

    void begin() { at_ = 0; }
    void send(std::uint64_t word, unsigned bits) {
        (void)exchange(word, bits);
        (void)exchange(crc_of(word, bits), 16);
    }
    std::uint64_t exchange(std::uint64_t word, unsigned bits) {
        std::uint64_t received = 0;
        while (bits-- > 0) {
            const bool is_damaged = at_++ == damaged_;
            if (is_damaged) { damaged_ = kNone; }
            received = received << 1 | std::uint64_t{transfer_(true, ((word >> bits & 1) != 0) != is_damaged)};
        }
        return received;
    }

    std::function<bool(bool, bool)> transfer_;
    std::size_t at_ = 0;  // bits of this transaction
    std::size_t damaged_ = kNone;
};

}  // namespace lockstep::rtl
