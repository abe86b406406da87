// Inputs of a device: each follows its pin once the pin has kept its level for a while.
#pragma once

#include <algorithm>
#include <array>
#include <cstdint>
#include <optional>

#include "core/hardware/device_setup.hpp"

namespace lockstep {

class InputFilter {
public:
    /// Returns the inputs that change at once, because their level has another meaning from now on.
    std::uint32_t set(const DeviceSetup& setup) {
        const std::uint32_t changed = inverted_ ^ setup.inputs_inverted;
        closed_ ^= changed;
        inverted_ = setup.inputs_inverted;
        debounce_ = setup.debounce;
        return changed;
    }

    /// pins: their levels after tick `now`; pin n is bit n. Returns the inputs that change at this tick.
    std::uint32_t look(std::uint32_t pins, Tick now) {
        const std::uint32_t different = (pins ^ inverted_) ^ closed_;
        if (different == 0 && pending_ == 0) { return 0; }
        std::uint32_t changed = 0;
        for (std::uint32_t n = 0; n < kMostInputs; ++n) {
            const std::uint32_t bit = std::uint32_t{1} << n;
            if ((different & bit) == 0) { continue; }
            if ((pending_ & bit) == 0) { since_[n] = now; }
            changed |= now - since_[n] >= debounce_[n] ? bit : 0;
        }
        closed_ ^= changed;
        pending_ = different & ~changed;
        return changed;
    }

    /// The tick at which an input changes if its pin keeps its level. nullopt: none will.
    std::optional<Tick> next() const {
        std::optional<Tick> first;
        for (std::uint32_t n = 0; pending_ != 0 && n < kMostInputs; ++n) {
            if ((pending_ >> n & 1) == 0) { continue; }
            first = std::min(first.value_or(since_[n] + debounce_[n]), since_[n] + debounce_[n]);
        }
        return first;
    }

    std::uint32_t closed() const { return closed_; }

private:
    std::uint32_t inverted_ = 0;
    std::array<Ticks, kMostInputs> debounce_{};
    std::array<Tick, kMostInputs> since_{};  // of the pending ones: when the pin changed
    std::uint32_t closed_ = 0;
    std::uint32_t pending_ = 0;  // the pin has another level than the input
};

}  // namespace lockstep
