// The device's side of the capture ring: the tick of every step.
#pragma once

#include <cstdint>
#include <utility>

#include "core/step/segment.hpp"
#include "sim_fpga/register_ring.hpp"
#include "sim_fpga/register_window.hpp"

namespace lockstep {

class CaptureRing {
public:
    /// entries: a power of two, at most registers::kCaptureRingMostEntries.
    CaptureRing(RegisterWindow window, std::size_t entries)
        : window_(std::move(window)), ring_(registers::kCaptureRing, entries, registers::kCaptureRingEntryBytes) {}

    /// Entries added, and steps that did not fit, since power-up.
    std::uint64_t head() const { return head_; }
    std::uint64_t lost() const { return lost_; }

    /// Stores a step. Returns false if there is no room. The host sees the step after head() is published.
    bool keep(StepEdge step) {
        if (head_ - tail_ >= ring_.entries()) { tail_ = window_.load(registers::kCaptureTail); }
        if (head_ - tail_ >= ring_.entries()) {
            ++lost_;
            return false;
        }
        const auto tick = static_cast<std::uint64_t>(step.tick.value);
        window_.store(ring_.entry(head_++), registers::kCaptureRingStepTick.word(tick) |
                                                (step.direction > 0 ? registers::kCaptureRingStepForward : 0));
        return true;
    }

private:
    RegisterWindow window_;
    RegisterRing ring_;
    std::uint64_t head_ = 0;
    std::uint64_t tail_ = 0;  // the host's, as last read
    std::uint64_t lost_ = 0;
};

}  // namespace lockstep
