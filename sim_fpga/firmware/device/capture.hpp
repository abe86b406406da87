// The device's side of the capture ring: the tick of every step.
#pragma once

#include <cstdint>

#include "sim_fpga/firmware/device/words.hpp"

namespace lockstep::firmware {

class Capture {
public:
    explicit Capture(Words& words) : words_(words) {}

    /// Stores a step. Returns false if there is no room. The host sees it after publish().
    bool keep(std::int64_t tick, int direction) {
        const std::uint64_t word = registers::kCaptureRingStepTick.word(static_cast<std::uint64_t>(tick)) |
                                   (direction > 0 ? registers::kCaptureRingStepForward : 0);
        sum_ += word;
        sums_ += sum_;
        if (head_ - tail_ >= kCaptureRoom) { tail_ = words_.load(registers::kCaptureTail); }
        if (head_ - tail_ >= kCaptureRoom) {
            ++lost_;
            return false;
        }
        words_.store_within(registers::kCaptureRing, kRing.entry(head_++), word);
        return true;
    }
    void publish() {
        words_.store(registers::kCaptureHead, head_);
        words_.store(registers::kCaptureLost, lost_);
        words_.store(registers::kCaptureSum, sum_);
        words_.store(registers::kCaptureSums, sums_);
    }

private:
    static constexpr Ring kRing{registers::kCaptureRing, kCaptureRoom, registers::kCaptureRingEntryBytes};

    Words& words_;
    std::uint64_t head_ = 0;
    std::uint64_t tail_ = 0;  // the host's, as last read
    std::uint64_t lost_ = 0;
    std::uint64_t sum_ = 0;
    std::uint64_t sums_ = 0;
};

}  // namespace lockstep::firmware
