// What the light of a board shows.
#pragma once

#include <cstdint>

namespace lockstep::firmware {

class BoardLight {
public:
    enum class State : std::uint8_t { Alone, HasHost, LostTicks };

    static constexpr std::uint32_t kIdentify_us = 10'000'000;

    /// Shows where the board is, for kIdentify_us from now on.
    void identify(std::uint32_t now_us) {
        is_identifying_ = true;
        since_us_ = now_us;
    }
    /// Whether the light is on. Times are microseconds of any clock, which may wrap.
    bool is_on(State state, std::uint32_t now_us) {
        is_identifying_ = is_identifying_ && now_us - since_us_ < kIdentify_us;
        const std::uint32_t pattern = is_identifying_ ? kFourFlashes : kPatterns[static_cast<unsigned>(state)];
        return (pattern << (now_us >> kSlotBits) % kSlots & 0x8000) != 0;
    }

private:
    // A pattern lasts 1.05 s. The highest of 16 bits is the first slot.
    static constexpr std::uint32_t kSlots = 16;
    static constexpr std::uint32_t kSlotBits = 16;  // 2^16 us
    static constexpr std::uint32_t kFourFlashes = 0b1010'1010'0000'0000;
    static constexpr std::uint32_t kPatterns[] = {
        0b1000'0000'0000'0000,  // a flash
        0b1111'1111'1111'1110,  // on, with a gap
        0b1100'1100'1100'1100,  // blinks
    };

    bool is_identifying_ = false;
    std::uint32_t since_us_ = 0;
};

}  // namespace lockstep::firmware
