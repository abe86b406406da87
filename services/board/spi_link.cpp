#include "services/board/spi_link.hpp"

#include <algorithm>
#include <random>
#include <thread>
#include <utility>

#include "services/runtime/clock.hpp"

namespace lockstep {
namespace {

using namespace std::chrono_literals;

constexpr auto kLookPeriod = 2ms;
constexpr auto kAbsentPeriod = 1s;  // of a motor that the chip may not have
constexpr auto kWait = 200us;
/// At this speed the chip is asked which speed it bears.
constexpr std::uint32_t kFirstSpeed_hz = 500'000;

std::int64_t now_ns() { return monotonic_now().count(); }

/// Not 0.
std::uint64_t drawn_power_up() {
    std::random_device random;
    return std::uniform_int_distribution<std::uint64_t>(1)(random);
}

}  // namespace

SpiLink::SpiLink(LinkName name, const std::vector<RegisterWindow>& windows) : name_(std::move(name)) {
    for (const RegisterWindow& window : windows) {
        motors_.push_back({{window, static_cast<unsigned>(motors_.size()), now_ns, drawn_power_up}});
    }
}

std::expected<void, std::string> SpiLink::open() {
    auto opened = SpiLine::open(name_.place, name_.speed_hz);
    if (!opened) { return std::unexpected(std::move(opened.error())); }
    chip_.emplace(line_.emplace(std::move(*opened)));
    bears_speed_ = false;
    return {};
}

void SpiLink::close() {
    repeated_ = refused();
    bytes_ = bytes_received();
    chip_.reset();
    line_.reset();
}

/// Each motor's orders are copied each time, and its words in their turn.
void SpiLink::exchange() {
    bool is_idle = true;
    if (!bears_speed_ && !(bears_speed_ = bears_speed())) { return std::this_thread::sleep_for(kLookPeriod); }
    for (Motor& motor : motors_) {
        const std::uint64_t before = chip_->bytes();
        if (!exchange(motor)) { fault_ = chip_->fault(); }
        if (fault_ == spi::Fault::Gone) { return close(); }
        is_idle = is_idle && chip_->bytes() == before;
    }
    if (is_idle) { std::this_thread::sleep_for(kWait); }
}

bool SpiLink::exchange(Motor& motor) {
    if (motor.motor.is_connected() && !motor.motor.obey(*chip_)) { return false; }
    const Time now = monotonic_now();
    if (now < motor.due) { return true; }
    const bool answers = motor.motor.look(*chip_);
    motor.due = now + (motor.motor.is_connected() ? Time{kLookPeriod} : Time{kAbsentPeriod});
    if (!answers) { return false; }
    fault_ = spi::Fault::None;
    ++answers_;
    return true;
}

/// A bit has at least eight clocks of the chip, which are the unit of its times.
bool SpiLink::bears_speed() {
    using namespace registers;
    line_->set_speed(std::min(name_.speed_hz, kFirstSpeed_hz));
    const auto words = chip_->read(0, kMagic, kTimeUnitPs / 8 + 1);
    fault_ = chip_->fault();
    if (fault_ == spi::Fault::Gone) { close(); }
    if (!words) { return false; }
    line_->set_speed(name_.speed_hz);
    const std::uint64_t unit_ps = words->back();
    most_hz_ = 0;
    if (words->front() != kMagicValue || unit_ps * name_.speed_hz <= 1'000'000'000'000) { return true; }
    most_hz_ = static_cast<std::uint32_t>(1'000'000'000'000 / unit_ps);
    return false;
}

std::string SpiLink::lack() const {
    if (most_hz_ != 0) {
        return "the link has " + std::to_string(name_.speed_hz) + " Hz, and the chip's design bears " +
               std::to_string(most_hz_) + "; write a lower speed, such as spi:" + name_.place + "@" +
               std::to_string(most_hz_);
    }
    switch (fault_) {
        case spi::Fault::None:
        case spi::Fault::Gone: break;
        case spi::Fault::Silent:
            return "nothing drives the line from the chip; check its power, the wires and ground, and that its design "
                   "is loaded";
        case spi::Fault::Foreign:
            return "what is connected does not answer as Lockstep's design does; check the design in the chip, and "
                   "that each wire is at its pin";
        case spi::Fault::Damaged:
            return "words arrive damaged; shorten the wires, add ground wires, or write a lower speed, such as spi:" +
                   name_.place + "@1000000";
        case spi::Fault::Busy: return "the chip is busy for ever; check its oscillator, and power it up again";
    }
    return "it does not answer; check its wires and its power";
}

void SpiLink::show(bool answers) {
    for (Motor& motor : motors_) { motor.motor.show_link(answers); }
}

}  // namespace lockstep
