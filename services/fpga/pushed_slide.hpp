// Pushes the slide of a simulated device as a file says, so that a person or a script can move it as a hand does.
#pragma once

#include <cstdint>
#include <filesystem>

#include "core/kinematics/motors.hpp"
#include "sim_fpga/plant.hpp"

namespace lockstep {

class PushedSlide {
public:
    /// `file` has lines of a motor's name and by how many mm its slide was pushed so far, in all. Empty: there is none.
    PushedSlide(const MotorConfig& motor, std::filesystem::path file);

    /// Call it in each loop. It reads the file once in kLoopsPerRead loops. A file that is missing pushes nothing.
    void apply_to(Plant& plant);

private:
    static constexpr std::uint64_t kLoopsPerRead = 10;

    MotorConfig motor_;
    std::filesystem::path file_;
    std::int64_t pushed_ = 0;  // steps
    std::uint64_t loops_ = 0;
};

}  // namespace lockstep
