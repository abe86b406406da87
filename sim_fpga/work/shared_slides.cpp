#include "sim_fpga/work/shared_slides.hpp"

#include <fcntl.h>
#include <sys/mman.h>
#include <unistd.h>

#include <cerrno>
#include <cstring>
#include <utility>

#include "core/kinematics/motors.hpp"

namespace lockstep {
namespace {

constexpr std::size_t kBytes = 4096;
static_assert(kMaxAxes * sizeof(std::int64_t) <= kBytes);

std::unexpected<std::string> cannot(const std::string& name, const char* action) {
    return std::unexpected("shared memory \"" + name + "\" of the simulated workpiece: cannot " + action + ": " +
                           std::strerror(errno));
}

}  // namespace

std::expected<SharedSlides, std::string> SharedSlides::open(const MachineConfig& machine) {
    const std::string name = "/lockstep-slides-" + machine.name + "-" + std::to_string(machine.network.domain);
    const int file = ::shm_open(name.c_str(), O_RDWR | O_CREAT | O_CLOEXEC, 0660);
    if (file < 0) { return cannot(name, "open it"); }
    void* memory = MAP_FAILED;
    if (::ftruncate(file, kBytes) == 0) {
        memory = ::mmap(nullptr, kBytes, PROT_READ | PROT_WRITE, MAP_SHARED, file, 0);
    }
    const int error = errno;
    ::close(file);
    errno = error;
    if (memory == MAP_FAILED) { return cannot(name, "map it"); }
    std::vector<Slide> slides;
    for (const MotorConfig& motor : motors_of(machine)) {
        slides.push_back({motor.plant.start_position_mm, motor.steps_per_mm});
    }
    return SharedSlides(std::shared_ptr<std::int64_t[]>(static_cast<std::int64_t*>(memory),
                                                        [](std::int64_t* words) { ::munmap(words, kBytes); }),
                        std::move(slides));
}

std::vector<double> SharedSlides::places_mm() const {
    std::vector<double> places;
    for (std::size_t m = 0; m < slides_.size(); ++m) {
        const bool has_steps = slides_[m].steps_per_mm > 0;
        const auto steps = static_cast<double>(word(m).load(std::memory_order_relaxed));
        places.push_back(slides_[m].start_mm + (has_steps ? steps / slides_[m].steps_per_mm : 0));
    }
    return places;
}

}  // namespace lockstep
