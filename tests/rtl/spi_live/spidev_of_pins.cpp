// For tests: a board in Verilog in real time, whose SPI is a socket that spidev.cpp takes for an SPI device. Each motor
// drives the plant of the machine's file.
#include <fmt/format.h>
#include <sys/socket.h>
#include <sys/un.h>

#include <algorithm>
#include <filesystem>
#include <thread>
#include <vector>

#include "Vslow_board.h"
#include "core/kinematics/motors.hpp"
#include "services/arguments/argument_parser.hpp"
#include "services/documents/edit/kept_settings.hpp"
#include "services/files/descriptor.hpp"
#include "services/runtime/clock.hpp"
#include "services/runtime/service_options.hpp"
#include "services/runtime/stop_signal.hpp"
#include "sim_fpga/plant.hpp"
#include "tests/rtl/clocked.hpp"

namespace lockstep::rtl {
namespace {

constexpr std::size_t kMotors = 3;
constexpr std::int64_t kClock_ns = 400;  // as slow_board.asm says
constexpr std::int64_t kTick_ns = 320'000;

struct Options {
    std::string machine_file;
    std::string board;
    std::string socket;
    std::string unplugged;  // while this file exists, no wire leads to the chip
};

class LiveBoard {
public:
    LiveBoard(const MachineSetup& machine, const std::string& board) {
        chip_.pins.select_n = 1;
        chip_.pins.sck = chip_.pins.mosi = 0;
        chip_.pins.memory_word = 0;
        const auto motors = motors_of(machine);
        for (unsigned n = 0; n < kMotors; ++n) {
            const DeviceName name{DeviceName::Kind::Linked, board, n};
            plants_.emplace_back(plant_of(machine, *std::ranges::find(motors, name, &MotorConfig::device)));
        }
        show_switches();
    }
    /// The chip runs up to the present. On a host that is too slow for that its clock loses time, which the machine
    /// finds out.
    void run() {
        constexpr std::int64_t kMostLate_ns = 100'000'000;
        const std::int64_t late = (monotonic_now() - began_).count() - now_ns();
        if (late > kMostLate_ns) { began_ += std::chrono::nanoseconds{late - kMostLate_ns}; }
        for (std::int64_t clocks = std::min(late, kMostLate_ns) / kClock_ns; clocks > 0; --clocks) { clock(); }
    }
    /// Lasts as long as a real one.
    void exchange(std::span<std::uint8_t> bytes) {
        run();
        for (std::uint8_t& byte : bytes) {
            for (int bit = 0; bit < 8; ++bit) {
                byte = static_cast<std::uint8_t>(byte << 1 | (transfer(true, (byte & 0x80) != 0) ? 1 : 0));
            }
        }
        (void)transfer(false, false);
        std::this_thread::sleep_until(
            std::chrono::steady_clock::time_point(began_ + std::chrono::nanoseconds{now_ns()}));
    }
    std::uint64_t steps() const { return steps_; }

private:
    std::int64_t now_ns() const { return clocks_ * kClock_ns; }
    /// A bit has eight clocks.
    bool transfer(bool select, bool bit) {
        chip_.pins.select_n = select ? 0 : 1;
        chip_.pins.mosi = bit ? 1 : 0;
        for (int n = 0; n < 4; ++n) { clock(); }
        chip_.pins.sck = select ? 1 : 0;
        const bool received = chip_.pins.miso != 0;
        for (int n = 0; n < 4; ++n) { clock(); }
        chip_.pins.sck = 0;
        return received;
    }
    void clock() {
        ++clocks_;
        chip_.clock();
        const unsigned rises = chip_.pins.step & ~was_step_;
        was_step_ = chip_.pins.step;
        for (std::size_t n = 0; rises >> n != 0; ++n) {
            if ((rises >> n & 1) != 0) { step(n); }
        }
    }
    void step(std::size_t motor) {
        const bool forward = (chip_.pins.direction >> motor & 1) != 0;
        plants_[motor].step({Tick{now_ns() / kTick_ns}, static_cast<std::int8_t>(forward ? 1 : -1)});
        ++steps_;
        show_switches();
    }
    void show_switches() {
        unsigned closed = 0;
        for (std::size_t n = 0; n < kMotors; ++n) { closed |= (plants_[n].pins() & 7U) << 3 * n; }
        chip_.pins.inputs = static_cast<std::uint16_t>(closed);
    }

    Clocked<Vslow_board> chip_;
    std::int64_t clocks_ = 0;
    unsigned was_step_ = 0;
    std::uint64_t steps_ = 0;
    std::vector<Plant> plants_;
    std::chrono::nanoseconds began_ = monotonic_now();
};

Descriptor listen_at(const std::string& path) {
    sockaddr_un at{.sun_family = AF_UNIX, .sun_path = {}};
    std::snprintf(at.sun_path, sizeof at.sun_path, "%s", path.c_str());
    Descriptor listener(::socket(AF_UNIX, SOCK_SEQPACKET | SOCK_NONBLOCK | SOCK_CLOEXEC, 0));
    const bool listens = ::bind(listener.get(), reinterpret_cast<const sockaddr*>(&at), sizeof at) == 0 &&
                         ::listen(listener.get(), 1) == 0;
    return listens ? std::move(listener) : Descriptor();
}

int serve(const Options& options) {
    const auto loaded = load_machine(options.machine_file);
    if (!loaded) { return end_with_bad_input(to_text(options.machine_file, loaded.error())); }
    const Descriptor listener = listen_at(options.socket);
    if (!listener.is_open()) { return end_with_bad_input(options.socket + ": cannot listen there"); }
    LiveBoard board(loaded->config, options.board);
    StopSignal stop;
    Descriptor host;
    std::vector<std::uint8_t> bytes(4096);
    while (!stop.requested()) {
        board.run();
        Descriptor arrived(::accept4(listener.get(), nullptr, nullptr, SOCK_CLOEXEC));
        if (arrived.is_open() && !host.is_open()) { host = std::move(arrived); }
        const ssize_t got = host.is_open() ? ::recv(host.get(), bytes.data(), bytes.size(), MSG_DONTWAIT) : -1;
        if (got == 0) { host = Descriptor(); }
        if (got <= 0) {
            std::this_thread::sleep_for(std::chrono::microseconds{200});
            continue;
        }
        const auto transaction = std::span(bytes).first(static_cast<std::size_t>(got));
        if (std::filesystem::exists(options.unplugged)) {
            std::ranges::fill(transaction, std::uint8_t{0xFF});
        } else {
            board.exchange(transaction);
        }
        if (::send(host.get(), transaction.data(), transaction.size(), MSG_NOSIGNAL) < 0) { host = Descriptor(); }
    }
    fmt::print("{} steps at the pins\n", board.steps());
    return 0;
}

}  // namespace
}  // namespace lockstep::rtl

int main(int argc, char** argv) {
    lockstep::ArgumentParser parser("For tests: a board of three motors in Verilog, in real time, behind its SPI.");
    lockstep::rtl::Options options;
    parser.add_option("--machine", options.machine_file, "the machine's configuration file").required();
    parser.add_option("--board", options.board, "the board's name in that file").required();
    parser.add_option("--socket", options.socket, "where the SPI is").required();
    parser.add_option("--unplugged", options.unplugged, "while this file exists, no wire leads to the chip").required();
    parser.action([&] { return lockstep::rtl::serve(options); });
    return parser.run(argc, argv);
}
