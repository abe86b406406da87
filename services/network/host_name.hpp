// The host's name, from the kernel.
#pragma once

#include <unistd.h>

#include <array>
#include <string>

namespace lockstep {

inline std::string host_name() {
    std::array<char, 256> name{};
    return gethostname(name.data(), name.size() - 1) == 0 ? name.data() : "";
}

}  // namespace lockstep
