// The device's side of the event ring: every change of an input and of an output.
#pragma once

#include <cstdint>

#include "sim_fpga/firmware/device/words.hpp"

namespace lockstep::firmware {

enum class EventKind : std::uint8_t { Input, Digital, Analog, CompareBegins, CompareEnds };

/// The words of an entry. `levels` and `channel` are fields of its WHAT.
struct Event {
    std::int64_t tick = 0;
    EventKind kind = EventKind::Input;
    std::uint64_t channel = 0;
    std::uint64_t levels = 0;
    std::int64_t value = 0;
    std::uint64_t detail = 0;
};

class Events {
public:
    explicit Events(Words& words) : words_(words) {}

    /// The host sees it after publish().
    void put(const Event& event) {
        if (head_ - words_.load(registers::kEventTail) >= kEventRoom) {
            ++lost_;
            return;
        }
        const std::size_t at = kRing.entry(head_++);
        words_.store(at + registers::kEventRingTick, event.tick);
        words_.store(at + registers::kEventRingWhat,
                     registers::kEventRingWhatKind.word(static_cast<std::uint64_t>(event.kind)) |
                         registers::kEventRingWhatChannel.word(event.channel) |
                         registers::kEventRingWhatLevels.word(event.levels));
        words_.store(at + registers::kEventRingValue, event.value);
        words_.store(at + registers::kEventRingDetail, event.detail);
    }
    void publish() {
        words_.store(registers::kEventHead, head_);
        words_.store(registers::kEventLost, lost_);
    }

private:
    static constexpr Ring kRing{registers::kEventRing, kEventRoom, registers::kEventRingEntryBytes};

    Words& words_;
    std::uint64_t head_ = 0;
    std::uint64_t lost_ = 0;
};

}  // namespace lockstep::firmware
