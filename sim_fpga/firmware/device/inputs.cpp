#include "sim_fpga/firmware/device/inputs.hpp"

namespace lockstep::firmware {

std::uint32_t Inputs::set(const Setup& setup) {
    const std::uint32_t changed = inverted_ ^ setup.inputs_inverted;
    closed_ ^= changed;
    inverted_ = setup.inputs_inverted;
    for (std::size_t n = 0; n < kMostInputs; ++n) { debounce_[n] = setup.debounce[n]; }
    return changed;
}

std::uint32_t Inputs::look(std::uint32_t pins, std::int64_t now) {
    const std::uint32_t different = (pins ^ inverted_) ^ closed_;
    if (different == 0 && pending_ == 0) { return 0; }
    std::uint32_t changed = 0;
    for (std::size_t n = 0; n < kMostInputs; ++n) {
        const std::uint32_t bit = std::uint32_t{1} << n;
        if ((different & bit) == 0) { continue; }
        if ((pending_ & bit) == 0) { since_[n] = now; }
        changed |= now - since_[n] >= debounce_[n] ? bit : 0;
    }
    closed_ ^= changed;
    pending_ = different & ~changed;
    return changed;
}

Due Inputs::next() const {
    Due first;
    for (std::size_t n = 0; pending_ >> n != 0; ++n) {
        if ((pending_ >> n & 1) != 0) { first = earlier(first, Due::at(since_[n] + debounce_[n])); }
        if (n + 1 == kMostInputs) { break; }
    }
    return first;
}

}  // namespace lockstep::firmware
