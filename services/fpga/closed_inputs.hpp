// Closes and opens the inputs of a simulated device as a file says, so that a person or a script can press them.
#pragma once

#include <cstdint>
#include <filesystem>
#include <string>
#include <vector>

#include "core/kinematics/motors.hpp"
#include "sim_fpga/plant.hpp"

namespace lockstep {

class ClosedInputs {
public:
    /// `file` has the names of the machine's closed inputs, separated by white space. Empty: there is none.
    ClosedInputs(const MachineConfig& machine, const MotorConfig& motor, std::filesystem::path file);

    /// Call it in each loop. It reads the file once in kLoopsPerRead loops. A file that is missing closes nothing.
    void apply_to(Plant& plant);

private:
    static constexpr std::uint64_t kLoopsPerRead = 10;

    std::vector<InputConfig> inputs_;  // of this device
    std::filesystem::path file_;
    std::uint64_t loops_ = 0;
};

}  // namespace lockstep
