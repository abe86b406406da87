// The device's side of the capture ring: the tick of every step.
#pragma once

#include <cstdint>
#include <utility>

#include "core/step/segment.hpp"
#include "sim_fpga/register_window.hpp"

namespace lockstep {

class CaptureRing {
public:
    explicit CaptureRing(RegisterWindow window) : window_(std::move(window)) {}

    /// Entries added, and steps that did not fit, since power-up.
    std::uint64_t head() const { return head_; }
    std::uint64_t lost() const { return lost_; }

    /// Stores a step. Returns false if there is no room. The host sees the step after head() is published.
    bool keep(StepEdge step) {
        if (head_ - tail_ >= registers::kCaptureRingEntries) { tail_ = window_.load(registers::kCaptureTail); }
        if (head_ - tail_ >= registers::kCaptureRingEntries) {
            ++lost_;
            return false;
        }
        const std::size_t slot = head_++ % registers::kCaptureRingEntries;
        const auto tick = static_cast<std::uint64_t>(step.tick.value);
        window_.store(registers::kCaptureRing + slot * registers::kCaptureRingEntryBytes,
                      (tick << 1) | static_cast<std::uint64_t>(step.direction > 0));
        return true;
    }

private:
    RegisterWindow window_;
    std::uint64_t head_ = 0;
    std::uint64_t tail_ = 0;  // the host's, as last read
    std::uint64_t lost_ = 0;
};

}  // namespace lockstep
