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
    /// The sum of the words of all steps, and the sum of its values after each step.
    std::uint64_t sum() const { return sum_; }
    std::uint64_t sums() const { return sums_; }

    /// Stores a step. Returns false if there is no room. The host sees the step after head() is published.
    bool keep(StepEdge step) {
        const std::uint64_t word = registers::kCaptureRingStepTick.word(static_cast<std::uint64_t>(step.tick.value)) |
                                   (step.direction > 0 ? registers::kCaptureRingStepForward : 0);
        sum_ += word;
        sums_ += sum_;
        if (head_ - tail_ >= ring_.entries()) { tail_ = window_.load(registers::kCaptureTail); }
        if (head_ - tail_ >= ring_.entries()) {
            ++lost_;
            return false;
        }
        window_.store(ring_.entry(head_++), word);
        return true;
    }

private:
    RegisterWindow window_;
    RegisterRing ring_;
    std::uint64_t head_ = 0;
    std::uint64_t tail_ = 0;  // the host's, as last read
    std::uint64_t lost_ = 0;
    std::uint64_t sum_ = 0;
    std::uint64_t sums_ = 0;
};

}  // namespace lockstep
