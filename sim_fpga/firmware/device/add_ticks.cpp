// The engine's additions in C++. A board's assembler replaces this file.
#include "sim_fpga/firmware/device/engine.hpp"

extern "C" std::uint32_t lockstep_add_ticks(lockstep::firmware::Accumulators* axis, std::uint32_t ticks) {
    std::uint32_t carries = 0;
    for (; ticks > 0; --ticks) {
        axis->velocity += axis->acceleration;
        axis->phase += axis->velocity;
        carries = carries << 1 | (axis->phase < axis->velocity ? 1 : 0);
    }
    return carries;
}
