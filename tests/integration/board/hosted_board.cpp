// A board of which only the chip is missing: the firmware's devices and its end of the link, compiled for this host, in
// real time, on a clock of its own, behind TCP. Each motor drives the plant of the machine's file.
//
// It executes ticks in blocks ahead of its pins, as the firmware of the RP2040 does.
#include <fmt/format.h>

#include <csignal>
#include <cstdio>
#include <deque>
#include <filesystem>
#include <iostream>
#include <memory>
#include <random>
#include <vector>

#include "clients/channel/listener.hpp"
#include "core/kinematics/motors.hpp"
#include "services/arguments/argument_parser.hpp"
#include "services/board/link_line.hpp"
#include "services/documents/edit/kept_settings.hpp"
#include "services/runtime/clock.hpp"
#include "services/runtime/service_options.hpp"
#include "services/runtime/stop_signal.hpp"
#include "sim_fpga/firmware/device/device.hpp"
#include "sim_fpga/firmware/link/board_words.hpp"
#include "sim_fpga/plant.hpp"

#include <sys/socket.h>

namespace lockstep::testing {
namespace {

struct Options {
    std::string machine_file;
    std::string board;
    std::string edges;      // a file for each step pin's edge: motor, tick, direction
    std::string unplugged;  // while this file exists, there is no line
    double ppm = 0;         // by which the board's crystal is fast
    int bad_bytes = 0;      // of 1000, either way: damaged or lost
    double rate = 0;        // bytes a second, either way; 0: as many as the connection takes
};

/// When a line of a certain speed is free for the next byte.
class LinePace {
public:
    explicit LinePace(double bytes_per_s) : ns_per_byte_(bytes_per_s > 0 ? 1e9 / bytes_per_s : 0) {}
    bool is_free(std::chrono::nanoseconds now) const { return free_ <= now; }
    void take(std::chrono::nanoseconds now, std::size_t bytes) {
        free_ = std::max(free_, now) +
                std::chrono::nanoseconds{static_cast<std::int64_t>(ns_per_byte_ * static_cast<double>(bytes))};
    }

private:
    double ns_per_byte_;
    std::chrono::nanoseconds free_{};
};

/// A motor's plant, whose steps are written down.
class WatchedPlant final : public firmware::Port {
public:
    WatchedPlant(Plant plant, std::string name, std::FILE* edges)
        : plant_(std::move(plant)), name_(std::move(name)), edges_(edges) {}
    std::uint32_t pins() const override { return plant_.pins(); }
    std::uint32_t step(const firmware::StepBlock& block, std::uint32_t steps) override {
        const std::uint32_t before = plant_.pins();
        std::uint32_t made = 0;
        for (; made < steps && plant_.pins() == before; ++made) { step(block.tick(made), block.direction); }
        return made;
    }
    void show(std::int64_t /*tick*/, std::uint16_t /*levels*/) override {}
    void show_analog(std::size_t /*channel*/, const firmware::Ramp& /*ramp*/) override {}
    std::int64_t encoder() const override { return plant_.encoder(); }

private:
    void step(std::int64_t tick, int direction) {
        plant_.step({Tick{tick}, static_cast<std::int8_t>(direction)});
        if (edges_ != nullptr) {
            std::fprintf(edges_, "%s %lld %d\n", name_.c_str(), static_cast<long long>(tick), direction);
        }
    }

    Plant plant_;
    std::string name_;
    std::FILE* edges_;
};

class HostedBoard final : public firmware::Exchange {
public:
    HostedBoard(const MachineSetup& machine, const Options& options, std::FILE* edges)
        : ppm_(options.ppm),
          bad_bytes_(options.bad_bytes),
          there_(options.rate),
          back_(options.rate),
          session_(std::random_device{}() | 1) {
        const auto motors = motors_of(machine);
        for (unsigned n = 0; n < firmware::BoardWords::kMostMotors; ++n) {
            const DeviceName name{DeviceName::Kind::Linked, options.board, n};
            const auto motor = std::ranges::find(motors, name, &MotorConfig::device);
            if (motor != motors.end()) { add(machine, *motor, n, edges); }
        }
        for (auto& device : devices_) { words_.push_back(&device->words()); }
        board_words_.emplace(words_.data(), words_.size(), *this);
        link_.emplace(*board_words_, session_);
    }

    void execute() {
        while (clock() - now_ >= kBlock) {
            now_ += kBlock;
            for (auto& device : devices_) { device->execute(now_); }
        }
    }
    /// Returns false if the line is gone.
    bool serve(LinkLine& line) {
        const auto bytes = line.receive();
        if (!bytes) { return false; }
        const auto now = monotonic_now();
        arrived_.insert(arrived_.end(), bytes->begin(), bytes->end());
        for (; !arrived_.empty() && there_.is_free(now); arrived_.pop_front()) {
            there_.take(now - kLoop, 1);
            take(arrived_.front());
        }
        for (; light_requests_ < board_words_->light_requests(); ++light_requests_) {
            std::puts("the light flashes");
            std::fflush(stdout);
        }
        firmware::Frame frame;
        for (int left = 8; left > 0 && back_.is_free(now) && line.is_free(); --left) {
            if (!link_->next_frame(now_us(), frame)) { break; }
            back_.take(now - kLoop, frame.size);
            spoil(frame);
            line.send(frame);
        }
        return true;
    }

private:
    static constexpr std::chrono::nanoseconds kLoop = std::chrono::milliseconds{1};  // about as long as a loop takes
    static constexpr std::int64_t kBlock = 128;
    static constexpr std::int64_t kMostAhead = 1191;

    void add(const MachineSetup& machine, const MotorConfig& motor, unsigned n, std::FILE* edges) {
        const firmware::Abilities abilities{.power_up = std::uint64_t{session_} << 8 | n,
                                            .least_step_ticks = 16,
                                            .lead_ticks = kBlock,
                                            .pin_ticks = kMostAhead,
                                            .longest_time = 7000,
                                            .longest_pwm_period = 0,
                                            .inputs = 3,
                                            .can_enable = true,
                                            .can_compare = false};
        plants_.push_back(std::make_unique<WatchedPlant>(plant_of(machine, motor), motor.name, edges));
        devices_.push_back(std::make_unique<firmware::Device>(*plants_.back(), abilities, 0));
    }

    std::uint32_t now_us() const { return static_cast<std::uint32_t>((monotonic_now() - began_).count() / 1000); }
    /// The board's clock: its pins', ahead by the ticks that may wait for them.
    std::int64_t clock() const {
        const double us = static_cast<double>((monotonic_now() - began_).count()) / 1000;
        return static_cast<std::int64_t>(us * (1 + ppm_ * 1e-6)) + kMostAhead;
    }
    bool is_bad() { return bad_bytes_ > 0 && static_cast<int>(random_() % 1000) < bad_bytes_; }
    void take(std::uint8_t byte) {
        if (is_bad()) {
            if (random_() % 2 == 0) { return; }
            byte = static_cast<std::uint8_t>(byte ^ (1U << random_() % 8));
        }
        link_->take(byte, now_us());
    }
    void spoil(firmware::Frame& frame) {
        std::size_t size = 0;
        for (std::size_t n = 0; n < frame.size; ++n) {
            std::uint8_t byte = frame.bytes[n];
            if (is_bad()) {
                if (random_() % 2 == 0) { continue; }
                byte = static_cast<std::uint8_t>(byte ^ (1U << random_() % 8));
            }
            frame.bytes[size++] = byte;
        }
        frame.size = size;
    }

    void enter() override { execute(); }
    void leave() override {}
    void prepare_orders() override {
        for (auto& device : devices_) { device->prepare_orders(); }
    }
    void take_orders() override {
        for (auto& device : devices_) { device->take_orders(); }
    }
    std::uint32_t publish(std::size_t motor) override {
        devices_[motor]->publish();
        return static_cast<std::uint32_t>(clock() - now_);
    }

    double ppm_;
    int bad_bytes_;
    LinePace there_;
    LinePace back_;
    std::deque<std::uint8_t> arrived_;
    std::uint32_t session_;
    std::chrono::nanoseconds began_ = monotonic_now();
    std::int64_t now_ = 0;
    std::vector<std::unique_ptr<WatchedPlant>> plants_;
    std::vector<std::unique_ptr<firmware::Device>> devices_;
    std::vector<firmware::Words*> words_;
    std::optional<firmware::BoardWords> board_words_;
    std::uint32_t light_requests_ = 0;  // that were obeyed
    std::optional<firmware::Link> link_;
    std::mt19937_64 random_{1};
};

/// The line that another process has opened, if it is plugged in.
class Plug {
public:
    Plug(int listener, std::string unplugged) : listener_(listener), unplugged_(std::move(unplugged)) {}

    void serve(HostedBoard& board) {
        const bool is_out = !unplugged_.empty() && std::filesystem::exists(unplugged_);
        Descriptor arrived(::accept4(listener_.get(), nullptr, nullptr, SOCK_NONBLOCK | SOCK_CLOEXEC));
        if (is_out) { line_.reset(); }
        if (!is_out && arrived.is_open()) { line_.emplace(std::move(arrived)); }
        if (line_ && !board.serve(*line_)) { line_.reset(); }
    }

private:
    Descriptor listener_;
    std::string unplugged_;
    std::optional<LinkLine> line_;
};

int run(const Options& options) {
    const auto loaded = load_machine(options.machine_file);
    if (!loaded) { return end_with_bad_input(to_text(options.machine_file, loaded.error())); }
    const auto& links = loaded->config.board_links;
    const auto board = std::ranges::find(links, options.board, &BoardLinkConfig::name);
    if (board == links.end()) { return end_with_bad_input("no board " + options.board); }
    const auto listener = listen_at(board->link.place, board->link.port);
    if (!listener) { return end_with_bad_input(listener.error()); }
    std::FILE* const edges = options.edges.empty() ? nullptr : std::fopen(options.edges.c_str(), "w");
    StopSignal stop;
    std::signal(SIGPIPE, SIG_IGN);
    HostedBoard hosted(loaded->config, options, edges);
    Plug plug(listener->socket, options.unplugged);
    while (!stop.requested()) {
        ::usleep(500);
        hosted.execute();
        plug.serve(hosted);
    }
    if (edges != nullptr) { std::fclose(edges); }
    return 0;
}

}  // namespace
}  // namespace lockstep::testing

int main(int argc, char** argv) {
    lockstep::ArgumentParser parser("For tests: a board compiled for this host, behind its TCP link, in real time.");
    lockstep::testing::Options options;
    parser.add_option("--machine", options.machine_file, "the machine's configuration file").required();
    parser.add_option("--board", options.board, "the board's name in that file").required();
    parser.add_option("--edges", options.edges, "a file for each edge of a step pin: motor, tick, direction");
    parser.add_option("--unplugged", options.unplugged, "while this file exists, there is no line");
    parser.add_option("--ppm", options.ppm, "by how much its crystal is fast");
    parser.add_option("--rate", options.rate, "how many bytes a second its line takes, either way");
    parser.add_option("--bad-bytes", options.bad_bytes, "how many of 1000 bytes are damaged or lost");
    parser.action([&] { return lockstep::testing::run(options); });
    return parser.run(argc, argv);
}
