// The device's side of the capture ring: the tick of every step.
#pragma once

#include <cstdint>

#include "sim_fpga/firmware/device/step_block.hpp"
#include "sim_fpga/firmware/device/words.hpp"

namespace lockstep::firmware {

class Capture {
public:
    explicit Capture(Words& words) : words_(words) {}

    /// Stores the first so many steps of a block. Returns false if there is no room for one. The host sees them after
    /// publish().
    bool keep(const StepBlock& block, std::uint32_t steps) {
        if (room() < steps) { tail_ = words_.load(registers::kCaptureTail); }
        const std::uint32_t kept = room() < steps ? room() : steps;
        const std::uint64_t first = registers::kCaptureRingStepTick.word(static_cast<std::uint64_t>(block.begin)) |
                                    (block.direction > 0 ? registers::kCaptureRingStepForward : 0);
        std::uint64_t sum = sum_;
        std::uint64_t sums = sums_;
        auto entry = static_cast<std::uint32_t>(head_);
        for (std::uint32_t n = 0; n < steps; ++n) {
            const std::uint64_t word = first + registers::kCaptureRingStepTick.word(block.after[n]);
            sum += word;
            sums += sum;
            if (n < kept) { words_.store_within(registers::kCaptureRing, kRing.entry(entry++), word); }
        }
        sum_ = sum;
        sums_ = sums;
        head_ += kept;
        lost_ += steps - kept;
        return kept == steps;
    }
    void publish() {
        words_.store(registers::kCaptureHead, head_);
        words_.store(registers::kCaptureLost, lost_);
        words_.store(registers::kCaptureSum, sum_);
        words_.store(registers::kCaptureSums, sums_);
    }

private:
    /// None if the host's tail is impossible.
    std::uint32_t room() const {
        const std::uint64_t used = head_ - tail_;
        return used < kCaptureRoom ? kCaptureRoom - static_cast<std::uint32_t>(used) : 0;
    }

    static constexpr Ring kRing{registers::kCaptureRing, kCaptureRoom, registers::kCaptureRingEntryBytes};

    Words& words_;
    std::uint64_t head_ = 0;
    std::uint64_t tail_ = 0;  // the host's, as last read
    std::uint64_t lost_ = 0;
    std::uint64_t sum_ = 0;
    std::uint64_t sums_ = 0;
};

}  // namespace lockstep::firmware
