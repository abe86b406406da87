// A line between two ends that damages, loses and delays bytes, in virtual time.
#pragma once

#include <cstdint>
#include <deque>
#include <random>

#include "sim_fpga/firmware/link/link.hpp"

namespace lockstep::testing {

/// How many of 1000 bytes.
struct LineFaults {
    int damaged = 0;
    int lost = 0;
    int late = 0;
};

class PoorLine {
public:
    /// A byte takes 10 us, as at 1 MBd.
    static constexpr std::uint32_t kByte_us = 10;

    PoorLine(LineFaults faults, std::uint64_t seed) : faults_(faults), random_(seed) {}

    /// Sends what `from` has to send and delivers what arrives at `to`.
    void advance(firmware::Link& from, firmware::Link& to, std::uint32_t now_us) {
        while (free_us_ <= now_us) {
            firmware::Frame frame;
            if (!from.next_frame(now_us, frame)) { break; }
            for (std::size_t n = 0; n < frame.size; ++n) { put(frame.bytes[n], now_us); }
        }
        for (; !bytes_.empty() && bytes_.front().at_us <= now_us; bytes_.pop_front()) {
            to.take(bytes_.front().byte, now_us);
        }
    }
    void repair() { faults_ = {}; }

private:
    struct Byte {
        std::uint8_t byte;
        std::uint32_t at_us;
    };
    bool happens(int many) { return static_cast<int>(random_() % 1000) < many; }

    void put(std::uint8_t byte, std::uint32_t now_us) {
        free_us_ = std::max(free_us_, now_us) + kByte_us;
        if (happens(faults_.late)) { free_us_ += static_cast<std::uint32_t>(random_() % 3000); }
        if (happens(faults_.lost)) { return; }
        if (happens(faults_.damaged)) { byte = static_cast<std::uint8_t>(byte ^ (1U << random_() % 8)); }
        bytes_.push_back({byte, free_us_});
    }

    LineFaults faults_;
    std::mt19937_64 random_;
    std::deque<Byte> bytes_;
    std::uint32_t free_us_ = 0;  // when the line has sent all bytes
};

}  // namespace lockstep::testing
