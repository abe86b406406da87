#include "services/axis/device_window.hpp"

#include "core/check.hpp"

namespace lockstep {

std::expected<RegisterWindow, std::string> open_window(const DeviceName& device) {
    check(device.kind != DeviceName::Kind::Simulated, "a device in its axis's process has no window to open");
    return device.kind == DeviceName::Kind::Shared ? RegisterWindow::open_shared(device.place)
                                                   : RegisterWindow::open_file(device.place);
}

}  // namespace lockstep
