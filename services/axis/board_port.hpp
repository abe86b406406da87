// The port to a motor of a board behind a link, through the register window that lockstep-board keeps for it. The
// board's clock is its own, and its readings come late; lockstep-board says when each was made.
#pragma once

#include <expected>
#include <memory>
#include <optional>
#include <string>

#include "core/kinematics/motors.hpp"
#include "services/axis/device_port.hpp"
#include "services/axis/window_port.hpp"
#include "services/runtime/clock.hpp"
#include "services/setup/machine_setup.hpp"

namespace lockstep {

class BoardPort final : public DevicePort {
public:
    /// The motor's device is linked. Error: lockstep-board does not run, the board does not answer, or as
    /// attach_driver().
    static std::expected<std::unique_ptr<DevicePort>, std::string> open(const MachineSetup& machine,
                                                                        const MotorConfig& motor,
                                                                        const MachineClock& clock);

    DeviceClock clock() const override { return DeviceClock::Own; }
    std::expected<std::optional<DeviceReading>, std::string> read(Tick own) override;
    std::expected<void, std::string> apply(const DeviceOrder& order) override { return port_.apply(order); }
    std::expected<std::uint32_t, std::string> drain(const OnStep& on_step) override { return port_.drain(on_step); }
    std::uint64_t lost_captures() const override { return port_.lost_captures(); }
    std::expected<void, std::string> drain_channels(const OnChannel& on_channel) override {
        return port_.drain_channels(on_channel);
    }
    std::uint64_t lost_channel_events() const override { return port_.lost_channel_events(); }
    std::string remedy() const override { return remedy_; }

private:
    /// When the registers were true.
    struct Times {
        std::uint64_t asked_ns;
        std::uint64_t answered_ns;
        std::uint64_t behind_ticks;
        bool operator==(const Times&) const = default;
    };
    BoardPort(RegisterWindow window, DeviceDriver driver, const MachineClock& clock, std::string remedy);
    Times times() const;
    DeviceReading reading(const DeviceStatus& status, const Times& times) const;

    RegisterWindow window_;
    Ticks pins_behind_;
    WindowPort port_;
    MachineClock clock_;
    std::string remedy_;
    std::optional<DeviceReading> newest_;
};

}  // namespace lockstep
