#include "services/fpga/fpga_service.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <chrono>
#include <expected>
#include <iostream>
#include <memory>
#include <optional>
#include <random>
#include <utility>

#include "core/kinematics/motors.hpp"
#include "services/documents/edit/kept_settings.hpp"
#include "services/fpga/closed_inputs.hpp"
#include "services/fpga/pushed_slide.hpp"
#include "services/runtime/clock.hpp"
#include "services/runtime/end_guard.hpp"
#include "services/runtime/log.hpp"
#include "services/runtime/periodic.hpp"
#include "services/runtime/service_options.hpp"
#include "sim_fpga/contacts/touched_device.hpp"

namespace lockstep {
namespace {

constexpr std::chrono::milliseconds kPeriod{1};

std::uint64_t drawn_number() {
    std::random_device random;
    return std::uniform_int_distribution<std::uint64_t>()(random);
}

/// The device and the plant that it drives. If another process removes or overwrites the registers, the device powers
/// up again, and the slide stays where it is.
class Board {
public:
    Board(const FpgaOptions& options, MakeDevice make, const MotorConfig& motor, const MachineSetup& machine)
        : options_(options),
          make_(make),
          tick_ns_(machine.tick_ns),
          clock_(machine.tick_ns, machine.timing.time_source),
          inputs_(machine, motor, options.closed_inputs),
          slide_(motor, options.pushes),
          plant_(plant_of(machine, motor)) {}

    /// Error: why its registers cannot be created.
    std::expected<void, std::string> power_up() {
        if (device_) { plant_ = device_->plant(); }
        device_.reset();  // closes its window, which frees the name
        auto window = options_.file.empty() ? RegisterWindow::create_shared(options_.name)
                                            : RegisterWindow::create_file(options_.file);
        if (!window) { return std::unexpected(window.error()); }
        device_ = make_({std::move(*window), plant_, tick_ns_, clock_.now(), drawn_number()});
        log_info(fmt::format("device \"{}{}\" is powered up", options_.name, options_.file));
        return {};
    }

    /// Error: that of TouchedDevice::open.
    std::expected<void, std::string> follow_slides(const MachineSetup& machine, MotorIndex motor) {
        auto touched = TouchedDevice::open(machine, machine.network.domain, motor, clock_.now());
        if (!touched) { return std::unexpected(touched.error()); }
        touched_.emplace(std::move(*touched));
        return {};
    }

    std::expected<void, std::string> advance() {
        if (!device_->is_intact()) {
            log_error(
                "the registers were overwritten or removed; the device powers up again, and the axis must be homed");
            if (auto up = power_up(); !up) { return up; }
        }
        inputs_.apply_to(device_->plant());
        slide_.apply_to(device_->plant());
        const auto run = [this](Tick until) { device_->advance(until); };
        touched_ ? touched_->advance(clock_.now(), device_->plant(), run) : run(clock_.now());
        return {};
    }

private:
    FpgaOptions options_;
    MakeDevice make_;
    std::int64_t tick_ns_;
    MachineClock clock_;
    ClosedInputs inputs_;
    PushedSlide slide_;
    Plant plant_;
    std::unique_ptr<ServedDevice> device_;
    std::optional<TouchedDevice> touched_;  // none: the machine's slides touch nothing
};

std::expected<Board, std::string> set_up(const FpgaOptions& options, MakeDevice make) {
    const auto loaded = load_machine(options.machine_file);
    if (!loaded) { return std::unexpected(to_text(options.machine_file, loaded.error())); }
    const MachineSetup& machine = loaded->config;
    const auto motor = motor_named(machine, options.axis);
    if (!motor) { return std::unexpected(options.machine_file + ": no axis \"" + options.axis + "\""); }
    Board board(options, make, motors_of(machine)[*motor], machine);
    if (auto up = board.power_up(); !up) { return std::unexpected(up.error()); }
    if (!TouchedDevice::is_needed(machine)) { return board; }
    if (auto followed = board.follow_slides(machine, *motor); !followed) { return std::unexpected(followed.error()); }
    return board;
}

}  // namespace

int serve_fpga(const FpgaOptions& options, MakeDevice make) {
    StopSignal stop;
    const EndGuard guard(stop);
    if (const auto log = open_log({.service = "fpga", .axis = options.axis, .in_background = true}); !log) {
        std::cerr << log.error() << '\n';
        return 1;
    }
    auto board = set_up(options, make);
    if (!board) { return end_with_failure(board.error()); }
    PeriodicLoop loop(kPeriod);
    std::expected<void, std::string> well;
    loop.run(stop, [&](std::chrono::nanoseconds) {
        well = board->advance();
        if (!well) { stop.request(); }
    });
    if (!well) { return end_with_failure(well.error()); }
    log_info("ended; the loop was at most {} us late", loop.worst_lateness().count() / 1000);
    return 0;
}

}  // namespace lockstep
