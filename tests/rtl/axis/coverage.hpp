// Counts the states of a device that a drawn host has reached: a comparison of devices that stay at rest proves
// nothing.
#pragma once

#include <gtest/gtest.h>

#include <array>
#include <bit>
#include <cstddef>
#include <cstdint>
#include <cstdlib>

#include "sim_fpga/registers.hpp"

namespace lockstep::rtl {

class Coverage {
public:
    /// After each tick. bench: has what the device shows.
    template <typename Bench>
    void note(const Bench& bench) {
        const std::uint64_t status = bench.load(registers::kStatus);
        for (unsigned bit = 0; bit < kBits; ++bit) { bits_[bit] += static_cast<int>((status & ~status_) >> bit & 1); }
        status_ = status;
        const std::uint64_t frame = bench.load(registers::kFrame);
        joins_ += frame == frame_ + 1 && frame > 1 ? 1 : 0;
        frame_ = frame;
        steps_ = bench.load(registers::kCaptureHead);
        lost_steps_ = bench.load(registers::kCaptureLost);
        events_ = bench.load(registers::kEventHead);
        lost_events_ = bench.load(registers::kEventLost);
    }
    /// Of several devices together.
    Coverage& operator+=(const Coverage& other) {
        for (unsigned bit = 0; bit < kBits; ++bit) { bits_[bit] += other.bits_[bit]; }
        joins_ += other.joins_;
        steps_ += other.steps_;
        lost_steps_ += other.lost_steps_;
        events_ += other.events_;
        lost_events_ += other.lost_events_;
        return *this;
    }
    /// How many frames began at the end of another one's body.
    int joins() const { return joins_; }
    void expect_all() const {
        using namespace registers;
        EXPECT_GT(steps_, 2'000) << "steps";
        EXPECT_GT(lost_steps_, 10) << "steps";
        EXPECT_GT(events_, 200) << "changes of inputs and outputs";
        EXPECT_GT(lost_events_, 10) << "changes of inputs and outputs";
        EXPECT_GT(joins_, 500) << "frames that began at the end of another one's body";
        for (const std::uint64_t bit :
             {kStatusFinished, kStatusInTail, kStatusLimitMin, kStatusLimitMax, kStatusHome, kStatusStoppedByLimit,
              kStatusStoppedByTrigger, kStatusStoppedByHost, kStatusBadSegment, kStatusCaptureOverflow, kStatusEnabled,
              kStatusHostSilent, kStatusStoppedByInput, kStatusBadSetup, kStatusBadOutput}) {
            EXPECT_GT(bits_[static_cast<std::size_t>(std::countr_zero(bit))], 5) << "bit " << std::countr_zero(bit);
        }
    }

private:
    static constexpr unsigned kBits = 16;
    std::array<int, kBits> bits_{};  // how many ticks set this bit of STATUS
    std::uint64_t status_ = 0;
    std::uint64_t frame_ = 0;
    int joins_ = 0;
    std::uint64_t steps_ = 0;
    std::uint64_t lost_steps_ = 0;
    std::uint64_t events_ = 0;
    std::uint64_t lost_events_ = 0;
};

/// How many pieces a drawn host runs.
inline std::int64_t wanted_pieces() {
    const char* asked = std::getenv("LOCKSTEP_RTL_PIECES");
    return asked != nullptr ? std::atoll(asked) : 30'000;
}

}  // namespace lockstep::rtl
