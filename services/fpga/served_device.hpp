// A device in a register window, with the plant that it drives: what a process of services/fpga serves.
#pragma once

#include <cstdint>
#include <memory>

#include "core/units.hpp"
#include "sim_fpga/plant.hpp"
#include "sim_fpga/register_window.hpp"

namespace lockstep {

class ServedDevice {
public:
    virtual ~ServedDevice() = default;

    /// Executes all ticks up to and including `until`, then publishes its state.
    virtual void advance(Tick until) = 0;
    /// Whether the registers are still those of this device, and the host's are valid.
    virtual bool is_intact() const = 0;
    virtual Plant& plant() = 0;

protected:
    ServedDevice() = default;
    ServedDevice(const ServedDevice&) = default;
    ServedDevice& operator=(const ServedDevice&) = default;
};

/// With this a device begins after power-up: at rest, after tick `now`.
struct PowerUp {
    RegisterWindow window;
    Plant plant;
    std::int64_t tick_ns;
    Tick now;
    std::uint64_t number;  // for POWER_UP
};

using MakeDevice = std::unique_ptr<ServedDevice> (*)(const PowerUp&);

}  // namespace lockstep
