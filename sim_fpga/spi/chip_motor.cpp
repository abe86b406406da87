#include "sim_fpga/spi/chip_motor.hpp"

#include <algorithm>
#include <array>
#include <utility>

#include "sim_fpga/firmware/link/look_word.hpp"

namespace lockstep::spi {

using namespace registers;

namespace {

constexpr std::size_t kWord = sizeof(std::uint64_t);
constexpr std::size_t kConstants = kPinTicks / kWord + 1;
constexpr std::size_t kShown = (kAnalogUpper - kSequence) / kWord + 1;
/// The words of the host but for the rings: where they begin, and how many there are. The chip has memory for all words
/// of the two tables.
constexpr std::array kHostWords{std::pair{kRunRequest, (kDirectOutputs - kRunRequest) / kWord + 1},
                                std::pair{kSetupRequest, (kCompareTicks - kSetupRequest) / kWord + 1},
                                std::pair{kAnalogTable, std::size_t{64}}};
static_assert(kAnalogTable + 64 * kWord == kInputTable + 32 * kInputTableEntryBytes);
constexpr int kMostShows = 20;    // until SEQUENCE changes
constexpr int kMostMessages = 8;  // in one call

/// Words may follow each other in a write. Those that are no ring's wait for the end of a tick, each by itself.
bool is_ring(std::size_t offset) { return offset >= kSegmentRing; }

}  // namespace

ChipMotor::ChipMotor(RegisterWindow window, unsigned number, Now now, std::function<std::uint64_t()> draw)
    : window_(window), orders_(std::move(window)), number_(number), now_(std::move(now)), draw_(std::move(draw)) {}

bool ChipMotor::look(ChipSpi& chip) {
    if (!is_connected_ && !connect(chip)) { return false; }
    return !is_connected_ || look_at_words(chip);
}

/// The chip shows words when it has ended what it does at power-up.
bool ChipMotor::connect(ChipSpi& chip) {
    if (!chip.read(number_, kMagic, 1)) { return false; }  // short, because the chip may not have this motor
    const auto constants = chip.read(number_, kMagic, kConstants);
    if (!constants) { return false; }
    const auto word = [&](std::size_t offset) { return (*constants)[offset / kWord]; };
    if (word(kMagic) != kMagicValue || word(kVersion) != kVersionValue || word(kMapChecksum) != kMapChecksumValue) {
        return show_foreign(*constants);
    }
    if (!is_shown(chip)) { return false; }
    const auto session = chip.read(number_, kSessionWord, 1);
    if (!session) { return false; }
    if (session->front() == 0 && !begin_after_power_up(chip)) { return false; }
    if (session->front() != 0 && session->front() != session_ && !take_over(chip)) { return false; }
    session_ = session->front() != 0 ? session->front() : session_;
    sequence_ = tick_ = 0;
    captures_.entries = word(kCaptureEntries);
    captures_.shown = kCaptureRingMostEntries;
    events_.entries = events_.shown = word(kEventEntries);
    take(kMagic, *constants);
    orders_.take(kCaptureEntries, captures_.shown);
    orders_.take(kPowerUp, session_);
    is_connected_ = true;
    return true;
}

/// Returns false if the chip does not obey.
bool ChipMotor::is_shown(ChipSpi& chip) {
    const auto before = chip.read(number_, kSequence, 1);
    for (int shows = kMostShows; before && shows > 0; --shows) {
        if (!chip.show(number_)) { return false; }
        const auto shown = chip.read(number_, kSequence, 1);
        if (!shown || *shown != *before) { return shown.has_value(); }
    }
    return false;
}

/// Only the words that tell what it is have a meaning.
bool ChipMotor::show_foreign(std::span<const std::uint64_t> constants) {
    take(kMagic, constants.first(kTickNs / kWord + 1));
    orders_.take(kSequence, 2);
    publish(now_());
    return true;
}

/// The chip's memory is not 0 then, and its host's words may be those that were still on their way. Its session comes
/// last.
bool ChipMotor::begin_after_power_up(ChipSpi& chip) {
    orders_.begin();
    pending_.clear();
    captures_.taken = events_.taken = capture_tail_ = armed_ = 0;
    const std::array drawn{draw_()};
    session_ = 0;
    for (const auto& [first, words] : kHostWords) {
        if (!chip.write(number_, first, std::vector<std::uint64_t>(words))) { return false; }
    }
    if (!chip.write(number_, kPowerUp, drawn) || !chip.write(number_, kSessionWord, drawn)) { return false; }
    session_ = drawn[0];
    return true;
}

/// The chip has words of another host, the process before this one.
bool ChipMotor::take_over(ChipSpi& chip) {
    orders_.begin();
    pending_.clear();
    for (const auto& [first, count] : kHostWords) {
        const auto words = chip.read(number_, first, count);
        if (!words) { return false; }
        take(first, *words);
        if (first != kRunRequest) { continue; }
        armed_ = (*words)[(kArmed - first) / kWord];
        captures_.taken = capture_tail_ = (*words)[(kCaptureTail - first) / kWord];
        events_.taken = (*words)[(kEventTail - first) / kWord];
    }
    return true;
}

/// If SEQUENCE did not change, the command to show was lost. After a power-up it begins again.
bool ChipMotor::look_at_words(ChipSpi& chip) {
    for (int shows = kMostShows; shows > 0; --shows) {
        const std::int64_t asked = now_();
        if (!chip.show(number_)) { return false; }
        const auto words = chip.read(number_, kSequence, kShown);
        if (!words) { return false; }
        const auto word = [&](std::size_t offset) { return (*words)[(offset - kSequence) / kWord]; };
        if (word(kSequence) == sequence_) { continue; }
        if (word(kSequence) < sequence_ || word(kTick) < tick_) {
            is_connected_ = false;
            return connect(chip);
        }
        if (!take_captures(chip, word(kCaptureHead)) || !take_ring(chip, events_, word(kEventHead))) { return false; }
        sequence_ = word(kSequence);
        tick_ = word(kTick);
        take(kSequence, *words);
        publish(asked);
        return true;
    }
    return false;
}

void ChipMotor::take(std::size_t offset, std::span<const std::uint64_t> words) {
    for (const std::uint64_t word : words) { orders_.take(std::exchange(offset, offset + kWord), word); }
}

/// The registers were true between `asked` and now.
void ChipMotor::publish(std::int64_t asked) {
    orders_.take(firmware::kLookWord, firmware::LookTime{static_cast<std::uint32_t>(asked / 1000), 0}.word());
    orders_.show(now_());
}

/// Copies the entries up to `head`, which stay as they are until the host takes them off the ring. There are no more
/// than the ring has.
bool ChipMotor::take_ring(ChipSpi& chip, Ring& ring, std::uint64_t head) {
    if (head - ring.taken > ring.entries) { ring.taken = head - ring.entries; }
    while (ring.taken != head) {
        const std::uint64_t at = ring.taken % ring.entries;
        const std::uint64_t entries = std::min(head - ring.taken, ring.entries - at);  // the window's are a multiple
        const auto words = chip.read(number_, ring.offset + at * ring.entry_bytes, entries * ring.entry_bytes / kWord);
        if (!words) { return false; }
        take(ring.offset + ring.taken % ring.shown * ring.entry_bytes, *words);
        ring.taken += entries;
    }
    return true;
}

/// As many as the window has room for, because the host may be late.
bool ChipMotor::take_captures(ChipSpi& chip, std::uint64_t head) {
    const std::uint64_t end = std::min(head, window_.load(kCaptureTail) + captures_.shown);
    if (!take_ring(chip, captures_, end)) { return false; }
    const std::array taken{captures_.taken};
    if (taken[0] != capture_tail_ && !chip.write(number_, kCaptureTail, taken)) { return false; }
    capture_tail_ = taken[0];
    return true;
}

bool ChipMotor::obey(ChipSpi& chip) {
    if (!is_connected_) { return true; }
    for (int left = kMostMessages; left > 0; --left) {
        if (pending_.empty()) { fill(); }
        if (pending_.empty()) { return true; }
        for (; !pending_.empty(); pending_.pop_front()) {
            const Words& next = pending_.front();
            if (!chip.write(number_, next.offset, next.values)) { return false; }
            if (next.offset == kArmed) { armed_ = next.values.front(); }
        }
    }
    return true;
}

/// The chip takes one word after the other. So no frame is armed while the words of two runs mix.
void ChipMotor::fill() {
    firmware::Message message;
    firmware::ItemWriter items(message);
    orders_.fill(number_, items);
    bool begins_run = false;
    bool arms = false;
    firmware::for_each_word(message, [&](unsigned, std::size_t offset, std::uint64_t) {
        begins_run |= offset == kRunRequest;
        arms |= offset == kArmed;
    });
    if (begins_run) { add(kArmed, 0); }
    firmware::for_each_word(message, [&](unsigned, std::size_t offset, std::uint64_t value) { add(offset, value); });
    if (begins_run && !arms && armed_ != 0) { add(kArmed, armed_); }
}

/// Words beyond the map are not for the chip, nor is how far the host has taken steps off the window's ring.
void ChipMotor::add(std::size_t offset, std::uint64_t value) {
    if (offset >= firmware::kLookWord || offset == kCaptureTail) { return; }
    const bool continues = !pending_.empty() && is_ring(offset) &&
                           pending_.back().offset + pending_.back().values.size() * kWord == offset;
    if (!continues) { pending_.push_back({offset, {}}); }
    pending_.back().values.push_back(value);
}

}  // namespace lockstep::spi
