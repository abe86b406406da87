#include "services/axis/device_window.hpp"

#include <string_view>

namespace lockstep {

std::expected<RegisterWindow, std::string> open_window(const std::string& device) {
    constexpr std::string_view kShared = "shm:";
    constexpr std::string_view kMapped = "uio:";
    if (device.starts_with(kShared)) { return RegisterWindow::open_shared(device.substr(kShared.size())); }
    if (device.starts_with(kMapped)) { return RegisterWindow::open_file(device.substr(kMapped.size())); }
    return std::unexpected("the device \"" + device + "\" is not known; it must be sim, shm:NAME or uio:PATH");
}

}  // namespace lockstep
