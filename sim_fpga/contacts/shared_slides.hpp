// The places of a machine's simulated slides in shared memory, so that the simulated device of one motor knows where
// the slides of the others are. Only a machine whose slides touch something has it (SlideContacts), and only simulated
// devices use it. The last process that closes it removes it. If this process is killed, the memory stays until the
// machine is up again.
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
#include "sim_fpga/contacts/slide_motion.hpp"

namespace lockstep {

class SharedSlides {
public:
    /// Creates the memory if it is missing. `domain`: of the machine's network; machines with one name may run in
    /// several. Error: it cannot be created or mapped.
    static std::expected<SharedSlides, std::string> open(const MachineConfig& machine, std::uint32_t domain);
    /// Its name, as of shm_open.
    static std::string name_of(const std::string& machine, std::uint32_t domain);

    /// Only one process publishes a motor's slide.
    void publish(MotorIndex motor, const SlideMotion& slide);
    /// Of each motor, at a tick. A slide that was never published stands at its start.
    std::vector<Position> places(Tick now) const;

private:
    enum Word : std::size_t { Turn, Steps, At, Speed, Words };  // Turn is odd while the others are written

    SharedSlides(std::shared_ptr<std::int64_t[]> words, const MachineConfig& machine);
    std::atomic_ref<std::int64_t> word(MotorIndex motor, Word word) const {
        return std::atomic_ref(words_.get()[motor * Words + word]);
    }
    SlideMotion slide(MotorIndex motor) const;

    std::shared_ptr<std::int64_t[]> words_;
    std::vector<MotorConfig> motors_;
    Ticks counts_on_;  // for how long a slide counts on at its speed
};

}  // namespace lockstep
