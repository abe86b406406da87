// Compares the ways of the pulses and of the encoder since the device rested last, to recognise an encoder that counts
// the wrong way: its channels A and B are exchanged. Steps that are lost leave the encoder behind the pulses, but do
// not turn it back. A push turns it back at once, but before the push it had followed the pulses.
#pragma once

#include <cstdint>
#include <cstdlib>

#include "core/axis/device/device.hpp"

namespace lockstep {

class EncoderWatch {
public:
    /// Call it for each reading. `is_new`: of a device that was found now.
    void look(const DeviceStatus& device, bool is_new) {
        count_ = device.position.count();
        encoder_ = device.encoder_count;
        if (device.moving && !is_new) {
            has_differed_ = has_differed_ || !mirrors();
            return;
        }
        rest_count_ = count_;
        rest_encoder_ = encoder_;
        has_differed_ = false;
    }
    /// The pulses have made so many steps or more, and at each reading the encoder had made about as many back.
    bool counts_back(std::int64_t least) const { return std::abs(way()) >= least && !has_differed_; }

private:
    std::int64_t way() const { return count_ - rest_count_; }
    bool mirrors() const {
        constexpr std::int64_t kShare = 8;  // of the way, by which they may differ, and by a step
        return std::abs(way() + encoder_ - rest_encoder_) <= 1 + std::abs(way()) / kShare;
    }

    bool has_differed_ = false;
    std::int64_t rest_count_ = 0;
    std::int64_t rest_encoder_ = 0;
    std::int64_t count_ = 0;
    std::int64_t encoder_ = 0;
};

}  // namespace lockstep
