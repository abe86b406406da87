// The places of a machine's simulated slides in shared memory, so that the simulated device of one motor knows where
// the slides of the others are. Only a machine with a workpiece has it, and only simulated devices use it. The last
// process that closes it removes it. If this process is killed, the memory stays until the machine is up again.
#pragma once

#include <atomic>
#include <cstddef>
#include <cstdint>
#include <expected>
#include <memory>
#include <string>
#include <vector>

#include "core/kinematics/motors.hpp"
#include "core/machine.hpp"
#include "core/units.hpp"

namespace lockstep {

class SharedSlides {
public:
    /// Creates the memory if it is missing. `domain`: of the machine's network; machines with one name may run in
    /// several. Error: it cannot be created or mapped.
    static std::expected<SharedSlides, std::string> open(const MachineConfig& machine, std::uint32_t domain);
    /// Its name, as of shm_open.
    static std::string name_of(const std::string& machine, std::uint32_t domain);

    /// Whole steps since the slide's power-up.
    void publish(MotorIndex motor, std::int64_t steps) { word(motor).store(steps, std::memory_order_relaxed); }
    /// Of each motor. A slide that was never published stands at its start.
    std::vector<Position> places() const;

private:
    SharedSlides(std::shared_ptr<std::int64_t[]> words, std::vector<MotorConfig> motors)
        : words_(std::move(words)), motors_(std::move(motors)) {}
    std::atomic_ref<std::int64_t> word(MotorIndex motor) const { return std::atomic_ref(words_.get()[motor]); }

    std::shared_ptr<std::int64_t[]> words_;
    std::vector<MotorConfig> motors_;
};

}  // namespace lockstep
