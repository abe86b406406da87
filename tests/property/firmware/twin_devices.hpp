// The simulated device and the firmware's, each with its own plant, behind the same words of the host.
#pragma once

#include <array>
#include <cstdint>
#include <memory>
#include <optional>
#include <string>
#include <utility>
#include <vector>

#include "sim_fpga/device.hpp"
#include "sim_fpga/firmware/device/device.hpp"

namespace lockstep::testing {

inline constexpr std::int64_t kTwinTick_ns = 1000;

/// A firmware's port to a plant.
class PlantPort final : public firmware::Port {
public:
    explicit PlantPort(Plant plant) : plant_(std::move(plant)) {}
    std::uint32_t pins() const override { return plant_.pins(); }
    std::uint32_t step(const firmware::StepBlock& block, std::uint32_t steps) override {
        const std::uint32_t before = plant_.pins();
        std::uint32_t made = 0;
        for (; made < steps && plant_.pins() == before; ++made) {
            plant_.step({Tick{block.tick(made)}, static_cast<std::int8_t>(block.direction)});
        }
        return made;
    }
    void show(std::int64_t tick, std::uint16_t levels) override {
        shown_ = levels;
        changes_.emplace_back(Tick{tick}, levels);
    }
    /// The levels of digital outputs, each with the tick from which on they hold.
    const std::vector<std::pair<Tick, std::uint16_t>>& changes() const { return changes_; }
    void show_analog(std::size_t channel, const firmware::Ramp& ramp) override { ramps_[channel] = ramp; }
    std::uint16_t shown() const { return shown_; }
    /// The value of an analog output after this tick.
    std::int64_t shown(std::size_t channel, Tick now) const { return ramps_[channel].at(now.value); }
    std::int64_t encoder() const override { return plant_.encoder(); }
    Plant& plant() { return plant_; }

private:
    Plant plant_;
    std::uint16_t shown_ = 0;
    std::vector<std::pair<Tick, std::uint16_t>> changes_;
    std::array<firmware::Ramp, firmware::kMostAnalog> ramps_;
};

class TwinDevices {
public:
    TwinDevices(const MotorConfig& motor, const firmware::Abilities& abilities, Tick now);

    std::uint64_t load(std::size_t offset) const { return window_.load(offset); }
    void store(std::size_t offset, std::uint64_t value) {
        window_.store(offset, value);
        firmware_->words().store(offset, value);
    }
    void advance(Tick until) {
        simulated_->advance(until);
        firmware_->advance(until.value);
    }
    void lose_ticks() {
        simulated_->lose_ticks();
        firmware_->lose_ticks();
    }
    /// Does the same to both plants.
    template <typename Change>
    void disturb(Change&& change) {
        change(simulated_->plant());
        change(port_.plant());
    }

    /// The first word that differs, with its values; nullopt if there is none.
    std::optional<std::string> difference() const;

private:
    std::optional<std::string> difference_in(std::size_t begin, std::size_t end) const;

    RegisterWindow window_ = RegisterWindow::in_process();
    PlantPort port_;
    std::unique_ptr<SimulatedDevice> simulated_;
    std::unique_ptr<firmware::Device> firmware_;
    Tick now_;
};

}  // namespace lockstep::testing
