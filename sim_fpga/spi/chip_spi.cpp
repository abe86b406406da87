#include "sim_fpga/spi/chip_spi.hpp"

#include <algorithm>
#include <array>

namespace lockstep::spi {
namespace {

enum class Kind : std::uint32_t { Read = 1, Write = 2, Show = 3 };

constexpr std::size_t kCommandBytes = 5;
constexpr std::size_t kPauseBytes = 1;
constexpr std::size_t kWordBytes = 10;
constexpr std::size_t kStatusBytes = 2;

std::uint16_t crc_of(std::span<const std::uint8_t> bytes) {
    unsigned crc = 0xFFFF;
    for (const std::uint8_t byte : bytes) {
        crc ^= static_cast<unsigned>(byte) << 8;
        for (int bit = 0; bit < 8; ++bit) { crc = crc << 1 ^ ((crc & 0x8000) != 0 ? 0x1021U : 0U); }
        crc &= 0xFFFF;
    }
    return static_cast<std::uint16_t>(crc);
}

/// Appends the value, highest byte first, and its CRC.
void put(Transaction& to, std::uint64_t value, std::size_t bytes) {
    const auto begin = static_cast<std::ptrdiff_t>(to.size());
    for (std::size_t n = bytes; n > 0; --n) { to.push_back(static_cast<std::uint8_t>(value >> 8 * (n - 1))); }
    const unsigned crc = crc_of(std::span(to.begin() + begin, to.end()));
    to.push_back(static_cast<std::uint8_t>(crc >> 8));
    to.push_back(static_cast<std::uint8_t>(crc));
}

Transaction command(Kind kind, unsigned motor, std::size_t offset) {
    Transaction bytes;
    put(bytes, std::uint64_t{static_cast<std::uint32_t>(kind)} << 22 | std::uint64_t{motor} << 17 | offset / 8, 3);
    return bytes;
}

Transaction read_of(unsigned motor, std::size_t offset, std::size_t count) {
    Transaction bytes = command(Kind::Read, motor, offset);
    bytes.resize(kCommandBytes + kPauseBytes + count * kWordBytes);
    return bytes;
}

/// The words of a read that arrived, up to the first damaged one.
std::size_t take_words(const Transaction& received, std::vector<std::uint64_t>& to) {
    std::size_t words = 0;
    for (std::size_t at = kCommandBytes + kPauseBytes; at + kWordBytes <= received.size(); at += kWordBytes, ++words) {
        const auto bytes = std::span(received).subspan(at, kWordBytes);
        if (crc_of(bytes) != 0) { break; }
        std::uint64_t word = 0;
        for (const std::uint8_t byte : bytes.first(8)) { word = word << 8 | byte; }
        to.push_back(word);
    }
    return words;
}

bool is_quiet(const Transaction& received) {
    return std::ranges::all_of(
        received, [&](std::uint8_t byte) { return byte == received.front() && (byte == 0x00 || byte == 0xFF); });
}

}  // namespace

bool ChipSpi::exchange(std::span<Transaction> transactions) {
    for (const Transaction& one : transactions) { bytes_ += one.size(); }
    if (port_.exchange(transactions)) { return true; }
    fault_ = Fault::Gone;
    return false;
}

/// Damage of one answer is no status: two must agree.
std::optional<ChipSpi::Status> ChipSpi::status_of(std::span<const Transaction> two) {
    std::array<std::optional<Status>, 2> found;
    for (std::size_t n = 0; n < found.size(); ++n) {
        const unsigned status = two[n][0];
        if ((status ^ two[n][1]) != 0xFF) {
            fault_ = is_quiet(two[n]) ? Fault::Silent : Fault::Foreign;
            return std::nullopt;
        }
        found[n] = Status{(status & 0x80) != 0, status & 0x3F};
    }
    if (found[0] != found[1] && !found[1]->is_busy) { return std::nullopt; }
    return found[1];
}

/// first: two answers that have arrived already. Asks again until the chip is not busy.
std::optional<ChipSpi::Status> ChipSpi::settled(std::span<const Transaction> first) {
    auto status = status_of(first);
    int tries = kMostStatusTries;
    for (int waits = kMostWaits; !status || status->is_busy; --waits) {
        if (status && waits == 0) { fault_ = Fault::Busy; }
        if (waits == 0 || (!status && --tries == 0)) { return std::nullopt; }
        std::array<Transaction, 2> two{Transaction(kStatusBytes), Transaction(kStatusBytes)};
        if (!exchange(two)) { return std::nullopt; }
        status = status_of(two);
    }
    return status;
}

/// Returns how many words arrived.
std::size_t ChipSpi::read_part(unsigned motor, std::size_t offset, std::size_t count, std::vector<std::uint64_t>& to) {
    std::array<Transaction, 1> one{read_of(motor, offset, count)};
    if (!exchange(one)) { return 0; }
    const std::size_t words = take_words(one[0], to);
    if (words == 0) {
        const bool answers = (one[0][0] ^ one[0][1]) == 0xFF;
        fault_ = answers ? Fault::Damaged : is_quiet(one[0]) ? Fault::Silent : Fault::Foreign;
    }
    return words;
}

std::optional<std::vector<std::uint64_t>> ChipSpi::read(unsigned motor, std::size_t offset, std::size_t count) {
    std::vector<std::uint64_t> words;
    words.reserve(count);
    fault_ = Fault::None;
    for (int tries = kMostTries; words.size() < count;) {
        const std::size_t part = std::min(count - words.size(), kMostRead);
        const std::size_t arrived = read_part(motor, offset + 8 * words.size(), part, words);
        if (arrived == part) { continue; }
        tries = arrived == 0 ? tries - 1 : kMostTries;
        ++repeated_;
        if (tries == 0 || fault_ == Fault::Gone) { return std::nullopt; }
    }
    fault_ = Fault::None;
    return words;
}

/// Returns how many words were written, or nullopt if this is unknown.
std::optional<std::size_t> ChipSpi::write_part(unsigned motor, std::size_t offset,
                                               std::span<const std::uint64_t> words) {
    std::array<Transaction, 4> all{read_of(motor, 0, 1), command(Kind::Write, motor, offset), Transaction(kStatusBytes),
                                   Transaction(kStatusBytes)};
    for (const std::uint64_t word : words) { put(all[1], word, 8); }
    if (!exchange(all)) { return std::nullopt; }
    std::vector<std::uint64_t> first;
    const bool begins_at_0 = take_words(all[0], first) == 1;
    const auto status = settled(std::span(all).last<2>());
    if (!status) { return std::nullopt; }
    if (!begins_at_0 || status->words > words.size()) {
        fault_ = Fault::Damaged;
        return std::nullopt;
    }
    return status->words;
}

bool ChipSpi::write(unsigned motor, std::size_t offset, std::span<const std::uint64_t> words) {
    fault_ = Fault::None;
    for (int tries = kMostTries; !words.empty();) {
        const auto part = words.first(std::min(words.size(), kMostWritten));
        const std::size_t written = write_part(motor, offset, part).value_or(0);
        words = words.subspan(written);
        offset += 8 * written;
        if (written == part.size()) { continue; }
        tries = written == 0 ? tries - 1 : kMostTries;
        ++repeated_;
        if (fault_ == Fault::None && written == 0) { fault_ = Fault::Damaged; }
        if (tries == 0 || fault_ == Fault::Gone) { return false; }
    }
    fault_ = Fault::None;
    return true;
}

bool ChipSpi::show(unsigned motor) {
    std::array<Transaction, 3> all{command(Kind::Show, motor, 0), Transaction(kStatusBytes), Transaction(kStatusBytes)};
    return exchange(all) && settled(std::span(all).last<2>());
}

}  // namespace lockstep::spi
