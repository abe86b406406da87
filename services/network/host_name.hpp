// The name of the host that this process runs on, as the kernel has it.
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
