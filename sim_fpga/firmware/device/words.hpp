// The words of a motor's register window, in the memory that a board has for them.
//
// They are at the same addresses as in the map (sim_fpga/registers.json). Between its areas there is no memory: words
// there read 0. One processor serves the host and executes the ticks, so words need no order of memory.
#pragma once

#include <cstddef>
#include <cstdint>

#include "sim_fpga/firmware/device/abilities.hpp"
#include "sim_fpga/registers.hpp"

namespace lockstep::firmware {

inline constexpr std::size_t kWordBytes = 8;

/// A part of the window with words on the board.
struct WindowArea {
    std::size_t begin;
    std::size_t bytes;
    bool is_of_host;  // the host writes it, otherwise the device
};

/// Behind the last register that the device writes.
inline constexpr std::size_t kDeviceWordsEnd = registers::kAnalogUpper + kWordBytes;

inline constexpr WindowArea kWindowAreas[] = {
    {0, kDeviceWordsEnd, false},
    {registers::kRunRequest, registers::kCompareTicks + kWordBytes - registers::kRunRequest, true},
    {registers::kAnalogTable, kMostAnalog* registers::kAnalogTableEntryBytes, true},
    {registers::kInputTable, kMostInputs* registers::kInputTableEntryBytes, true},
    {registers::kSegmentRing, kSegmentRoom* registers::kSegmentRingEntryBytes, true},
    {registers::kOutputRing, kOutputRoom* registers::kOutputRingEntryBytes, true},
    {registers::kEventRing, kEventRoom* registers::kEventRingEntryBytes, false},
    {registers::kCaptureRing, kCaptureRoom* registers::kCaptureRingEntryBytes, false},
};

constexpr std::size_t words_on_board() {
    std::size_t words = 0;
    for (const WindowArea& area : kWindowAreas) { words += area.bytes / kWordBytes; }
    return words;
}

class Words {
public:
    /// offset: in bytes, a multiple of 8.
    std::uint64_t load(std::size_t offset) const { return words_[index(offset)]; }
    void store(std::size_t offset, std::uint64_t value) {
        if (const std::size_t at = index(offset); at != kNowhere) { words_[at] = value; }
        if (const std::size_t entry = segment_entry(offset); entry < kSegmentRoom) {
            checked_[entry / 32] &= ~(std::uint32_t{1} << entry % 32);
        }
    }
    /// In the area that begins at `area`, which is known when this is compiled: takes a fraction of the time.
    std::uint64_t load_within(std::size_t area, std::size_t offset) const {
        return words_[index(area) + (offset - area) / kWordBytes];
    }
    void store_within(std::size_t area, std::size_t offset, std::uint64_t value) {
        words_[index(area) + (offset - area) / kWordBytes] = value;
    }
    void store(std::size_t offset, std::int64_t value) { store(offset, static_cast<std::uint64_t>(value)); }

    /// Marks an entry of the segment ring, by its offset, as a piece that can be executed, until a word of it is
    /// written.
    void mark_checked(std::size_t offset) {
        checked_[segment_entry(offset) / 32] |= std::uint32_t{1} << segment_entry(offset) % 32;
    }
    bool is_checked(std::size_t offset) const {
        return (checked_[segment_entry(offset) / 32] >> segment_entry(offset) % 32 & 1) != 0;
    }

    /// Whether there is such a word and the host writes it.
    static constexpr bool is_of_host(std::size_t offset) {
        for (const WindowArea& area : kWindowAreas) {
            if (offset - area.begin < area.bytes) { return area.is_of_host && offset % kWordBytes == 0; }
        }
        return false;
    }

private:
    static constexpr std::size_t kNowhere = words_on_board();

    /// Known when it is compiled, if the offset is.
    static constexpr std::size_t index(std::size_t offset) {
        std::size_t before = 0;
        for (const WindowArea& area : kWindowAreas) {
            if (offset - area.begin < area.bytes) { return before + (offset - area.begin) / kWordBytes; }
            before += area.bytes / kWordBytes;
        }
        return kNowhere;
    }

    /// Of offsets that are not in the ring: any number that no entry has.
    static constexpr std::size_t segment_entry(std::size_t offset) {
        return (offset - registers::kSegmentRing) / registers::kSegmentRingEntryBytes;
    }

    std::uint64_t words_[kNowhere + 1]{};  // the last one stays 0
    std::uint32_t checked_[kSegmentRoom / 32]{};
};

/// A ring's place in the window. Entries are numbered from power-up on, and their number is a power of two.
struct Ring {
    std::size_t offset;
    std::size_t entries;
    std::size_t entry_bytes;
    constexpr std::size_t entry(std::uint64_t index) const {
        return offset + (static_cast<std::size_t>(index) & (entries - 1)) * entry_bytes;
    }
};

}  // namespace lockstep::firmware
