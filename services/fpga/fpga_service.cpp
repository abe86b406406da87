#include "services/fpga/fpga_service.hpp"

#include <algorithm>
#include <chrono>
#include <expected>
#include <iostream>
#include <random>
#include <utility>

#include "services/documents/machine_file.hpp"
#include "services/runtime/clock.hpp"
#include "services/runtime/log.hpp"
#include "services/runtime/periodic.hpp"
#include "sim_fpga/device.hpp"

namespace lockstep {
namespace {

constexpr std::chrono::milliseconds kPeriod{1};

struct Hardware {
    AxisConfig axis;
    std::int64_t tick_ns;
    TimeSource time_source;
    RegisterWindow window;
};

std::uint64_t drawn_number() {
    std::random_device random;
    return std::uniform_int_distribution<std::uint64_t>()(random);
}

std::expected<Hardware, std::string> set_up(const FpgaOptions& options) {
    const auto machine = load_machine_file(options.machine_file);
    if (!machine) { return std::unexpected(to_text(options.machine_file, machine.error())); }
    const auto axis = std::ranges::find(machine->axes, options.axis, &AxisConfig::name);
    if (axis == machine->axes.end()) {
        return std::unexpected(options.machine_file + ": no axis \"" + options.axis + "\"");
    }
    auto window =
        options.file.empty() ? RegisterWindow::create_shared(options.name) : RegisterWindow::create_file(options.file);
    if (!window) { return std::unexpected(window.error()); }
    return Hardware{*axis, machine->tick_ns, machine->timing.time_source, std::move(*window)};
}

}  // namespace

int serve_fpga(const FpgaOptions& options) {
    const StopSignal stop;
    if (const auto log = open_log({.service = "fpga", .axis = options.axis}); !log) {
        std::cerr << log.error() << '\n';
        return 1;
    }
    auto hardware = set_up(options);
    if (!hardware) {
        log_error(hardware.error());
        return 1;
    }
    const MachineClock clock(hardware->tick_ns, hardware->time_source);
    const Plant plant(hardware->axis, hardware->tick_ns);
    SimulatedDevice device(hardware->window, plant, hardware->tick_ns, clock.now(), drawn_number());
    log_info("device \"" + options.name + options.file + "\" is powered up");
    PeriodicLoop loop(kPeriod);
    loop.run(stop, [&](std::chrono::nanoseconds) { device.advance(clock.now()); });
    log_info("ended; the loop was late by " + std::to_string(loop.worst_lateness().count() / 1000) + " us at worst");
    return 0;
}

}  // namespace lockstep
