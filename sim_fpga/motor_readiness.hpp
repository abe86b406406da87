// The setup of a device and the enabling of its motor, as the host requests them. No run begins before both.
#pragma once

#include <cstdint>
#include <optional>

#include "core/hardware/device_abilities.hpp"
#include "core/hardware/device_setup.hpp"
#include "sim_fpga/channel_words.hpp"
#include "sim_fpga/register_window.hpp"

namespace lockstep {

class MotorReadiness {
public:
    MotorReadiness(RegisterWindow window, const DeviceAbilities& abilities) : window_(window), abilities_(abilities) {}

    /// Returns a setup that the host newly requests. Refuses one that is beyond the abilities. A setup changes what
    /// inputs and pulses mean, so call it at rest only.
    std::optional<DeviceSetup> take_setup() {
        const std::uint64_t asked = window_.load(registers::kSetupRequest);
        if (asked == taken_ || asked == refused_) { return std::nullopt; }
        const DeviceSetup setup = load_setup(window_, abilities_.time_unit_ps);
        const bool is_possible = !lack_of(abilities_, setup);
        (is_possible ? taken_ : refused_) = asked;
        return is_possible ? std::optional(setup) : std::nullopt;
    }
    /// `falls_off`: the motor is disabled whatever the host requests. Returns whether this disables it.
    bool take_enable(bool falls_off, Tick now) {
        const bool was_enabled = is_enabled();
        if (window_.load(registers::kEnable) == 0 || falls_off) {
            enabled_.reset();
        } else if (!enabled_) {
            enabled_ = now;
        }
        return was_enabled && !is_enabled();
    }

    bool is_enabled() const { return enabled_.has_value(); }
    bool may_move(Tick now, Ticks enable_wait) const {
        return taken_ != 0 && enabled_ && now - *enabled_ >= enable_wait;
    }
    /// The number of the setup that was taken; 0 before the first.
    std::uint64_t setup_number() const { return taken_; }
    /// Whether the requested setup is beyond the abilities.
    bool refuses_setup() const { return refused_ != 0 && window_.load(registers::kSetupRequest) == refused_; }

private:
    RegisterWindow window_;
    DeviceAbilities abilities_;
    std::uint64_t taken_ = 0;      // the number of the setup
    std::uint64_t refused_ = 0;    // the number of one that is beyond the abilities
    std::optional<Tick> enabled_;  // since when
};

}  // namespace lockstep
