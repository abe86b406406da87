#include "services/axis/board_port.hpp"

#include <utility>

#include "services/axis/device_window.hpp"
#include "sim_fpga/firmware/host/link_words.hpp"

namespace lockstep {

std::expected<std::unique_ptr<DevicePort>, std::string> BoardPort::open(const MachineSetup& machine,
                                                                        const MotorConfig& motor,
                                                                        const MachineClock& clock) {
    auto window = open_window(motor.device, machine);
    if (!window) { return std::unexpected(window.error()); }
    auto driver = attach_driver(*window, machine, motor);
    if (!driver) { return std::unexpected(driver.error()); }
    return std::unique_ptr<DevicePort>(
        new BoardPort(std::move(*window), std::move(*driver), clock, link_remedy(motor.device, machine)));
}

BoardPort::BoardPort(RegisterWindow window, DeviceDriver driver, const MachineClock& clock, std::string remedy)
    : window_(std::move(window)),
      pins_behind_(driver.abilities().behind),
      port_(std::move(driver)),
      clock_(clock),
      remedy_(std::move(remedy)) {}

/// The registers belong to these times if the times are the same before and behind them. They change with each answer,
/// so if they are not, the driver's reading counts with the next one.
std::expected<std::optional<DeviceReading>, std::string> BoardPort::read(Tick own) {
    if (window_.load(firmware::kAnswersWord) == 0) { return std::unexpected("the board does not answer" + remedy_); }
    const Times before = times();
    const auto read = port_.read(own);
    if (!read) { return std::unexpected(read.error()); }
    const DeviceStatus& status = (*read)->status;
    if (before == times()) {
        newest_ = reading(status, before);
    } else if (newest_) {
        newest_->status.run_asked = status.run_asked;
    }
    return newest_;
}

BoardPort::Times BoardPort::times() const {
    return {window_.load(firmware::kAskedWord), window_.load(firmware::kAnsweredWord),
            window_.load(firmware::kBehindWord)};
}

/// The board's clock showed TICK earlier, by as much as it had counted beyond it. Its pins are a constant time behind.
DeviceReading BoardPort::reading(const DeviceStatus& status, const Times& times) const {
    const auto tick_at = [this](std::uint64_t ns) {
        return clock_.tick_at(std::chrono::nanoseconds{static_cast<std::int64_t>(ns)});
    };
    const Ticks behind{static_cast<std::int64_t>(times.behind_ticks)};
    return {status, tick_at(times.asked_ns) - behind - Ticks{1}, tick_at(times.answered_ns) - behind + Ticks{1},
            pins_behind_};
}

}  // namespace lockstep
