// The device's side of the event ring: every change of an input and of an output.
#pragma once

#include <cstdint>
#include <utility>

#include "sim_fpga/channel_words.hpp"
#include "sim_fpga/register_ring.hpp"

namespace lockstep {

class EventRing {
public:
    /// entries: a power of two, at most registers::kEventRingMostEntries.
    EventRing(RegisterWindow window, std::size_t entries)
        : window_(std::move(window)), ring_(registers::kEventRing, entries, registers::kEventRingEntryBytes) {}

    /// Entries added, and events that did not fit, since power-up.
    std::uint64_t head() const { return head_; }
    std::uint64_t lost() const { return lost_; }

    /// The host sees the event after head() is published.
    void put(const ChannelEvent& event) {
        if (head_ - window_.load(registers::kEventTail) >= ring_.entries()) {
            ++lost_;
            return;
        }
        store_event(window_, ring_.entry(head_++), event);
    }

private:
    RegisterWindow window_;
    RegisterRing ring_;
    std::uint64_t head_ = 0;
    std::uint64_t lost_ = 0;
};

}  // namespace lockstep
