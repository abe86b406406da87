// Compares the ways of the pulses and of the encoder since the device rested last, to recognise an encoder that counts
// the wrong way: its channels A and B are exchanged. Steps that are lost leave the encoder behind the pulses, but do
// not turn it back.
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
        if (device.moving && !is_new) { return; }
        rest_count_ = count_;
        rest_encoder_ = encoder_;
    }
    /// The pulses have made so many steps or more, and the encoder about as many back.
    bool counts_back(std::int64_t least) const {
        constexpr std::int64_t kShare = 8;  // of the way, by which they may differ, and by a step
        const std::int64_t way = count_ - rest_count_;
        const std::int64_t differ = std::abs(way + encoder_ - rest_encoder_);
        return std::abs(way) >= least && differ <= 1 + std::abs(way) / kShare;
    }

private:
    std::int64_t rest_count_ = 0;
    std::int64_t rest_encoder_ = 0;
    std::int64_t count_ = 0;
    std::int64_t encoder_ = 0;
};

}  // namespace lockstep
