// The board, and a host at each of its lines. At first only the host at the UART speaks.
#pragma once

#include <algorithm>
#include <array>
#include <deque>
#include <map>
#include <numeric>
#include <random>
#include <vector>

#include "services/axis/device_driver.hpp"
#include "sim_fpga/firmware/host/host_words.hpp"
#include "sim_fpga/firmware/link/identify_word.hpp"
#include "tests/simulation/board/pin_watch.hpp"

namespace lockstep::testing {

class BoardHost {
public:
    explicit BoardHost(std::uint32_t session) : link_(words_, session) {}

    /// The next bytes to send, at most so many.
    std::vector<std::uint8_t> send(std::size_t most, std::uint32_t now_us) {
        firmware::Frame frame;
        while (waiting_.size() < most && link_.next_frame(now_us, frame)) {
            waiting_.insert(waiting_.end(), frame.bytes, frame.bytes + frame.size);
        }
        const auto end = waiting_.begin() + static_cast<std::ptrdiff_t>(std::min(most, waiting_.size()));
        std::vector<std::uint8_t> bytes(waiting_.begin(), end);
        waiting_.erase(waiting_.begin(), end);
        return bytes;
    }
    void take(const std::vector<std::uint8_t>& bytes, std::uint32_t now_us) {
        for (const std::uint8_t byte : bytes) { link_.take(byte, now_us); }
    }
    DeviceDriver driver(std::size_t motor) { return DeviceDriver::attach(windows_[motor], kTick_ns).value(); }
    /// Asks the board to let its light blink.
    void identify() { windows_[1].store(firmware::kIdentifyWord, windows_[1].load(firmware::kIdentifyWord) + 1); }
    bool is_connected() const { return windows_[kMotors - 1].load(registers::kMagic) == registers::kMagicValue; }
    std::uint64_t tick() const { return windows_[0].load(registers::kTick); }

private:
    std::vector<RegisterWindow> windows_{RegisterWindow::in_process(), RegisterWindow::in_process(),
                                         RegisterWindow::in_process()};
    firmware::HostWords words_{windows_};
    firmware::Link link_;
    std::deque<std::uint8_t> waiting_;
};

enum class HostLine : std::size_t { Uart, Usb };

class BoardBench {
public:
    static constexpr std::uint32_t kSlice_us = 500;

    void run(std::uint32_t until_us) {
        constexpr std::size_t kUartBytes = 50;
        constexpr std::size_t kUsbBytes = 600;
        while (now_us_ < until_us) {
            EmulatedBoard::Request request{now_us_ + kSlice_us, levels_, std::exchange(plug_, Plug::AsItIs)};
            if (speaks_[0]) { request.by_uart = spoilt(hosts_[0].send(kUartBytes, now_us_)); }
            if (speaks_[1] && is_usb_open_) { request.by_usb = spoilt(hosts_[1].send(kUsbBytes, now_us_)); }
            if (is_babbling_ && random_() % 20 == 0) { babble(request.by_usb); }
            now_us_ += kSlice_us;
            take(board_.run(request));
        }
    }
    using Plug = EmulatedBoard::Plug;
    /// Before the next run.
    void plug(Plug event) { plug_ = event; }
    bool is_usb_open() const { return is_usb_open_; }
    bool is_in_boot_mode() const { return is_in_boot_mode_; }
    BoardHost& host(HostLine line) { return hosts_[static_cast<std::size_t>(line)]; }
    void let_speak(HostLine line, bool speaks) { speaks_[static_cast<std::size_t>(line)] = speaks; }
    /// Bytes a second that have come by USB in the busiest 5 ms so far.
    double busiest_usb() const { return static_cast<double>(most_usb_bytes_) * 200; }

    /// From now on any bytes come by USB among those of the host, in one slice of twenty.
    void babble() { is_babbling_ = true; }
    /// From now on one byte of a thousand comes damaged, either way.
    void damage() { is_poor_ = true; }
    /// The upper limit switch of a motor.
    void close_switch(std::size_t motor) { levels_ |= 1U << (14 + 3 * motor); }
    std::uint32_t now_us() const { return now_us_; }
    const std::vector<StepEdge>& steps(std::size_t motor) const { return pins_[motor].steps; }
    /// The changes of an output's pin so far.
    const std::vector<LevelChange>& levels(std::uint8_t pin) { return outputs_[pin]; }
    /// The edges of a pin with PWM so far.
    const std::vector<PinEdge>& edges(std::uint8_t pin) { return edges_[pin]; }
    /// When the machines of the motors began, in cycles.
    double start() const { return start_; }
    /// How often the board's light went on so far.
    int flashes() const { return flashes_; }
    void expect(std::size_t motor, const PinTimes& times) { pins_[motor].times = times; }
    /// The share of the busiest 2.5 ms so far in which the processor was in interrupts: it executed ticks.
    double busiest() const { return busiest_; }
    /// The cycles that the processor was in interrupts so far.
    double interrupted() const { return all_interrupted_; }

private:
    std::vector<std::uint8_t> spoilt(std::vector<std::uint8_t> bytes) {
        for (std::uint8_t& byte : bytes) {
            if (is_poor_ && random_() % 1000 == 0) { byte = static_cast<std::uint8_t>(byte ^ (1U << random_() % 8)); }
        }
        return bytes;
    }
    void babble(std::vector<std::uint8_t>& bytes) {
        for (auto left = random_() % 40; left > 0; --left) { bytes.push_back(static_cast<std::uint8_t>(random_())); }
        if (random_() % 4 == 0) { bytes.push_back(0); }
    }
    void take(const EmulatedBoard::Answer& answer) {
        measure(answer.interrupted);
        is_usb_open_ = answer.is_usb_open;
        is_in_boot_mode_ = answer.is_in_boot_mode;
        measure_usb(answer.by_usb.size());
        if (speaks_[0]) { hosts_[0].take(spoilt(answer.by_uart), now_us_); }
        if (speaks_[1]) { hosts_[1].take(spoilt(answer.by_usb), now_us_); }
        for (const PinEdge& edge : answer.edges) {
            if (edge.pin == kStartPin) { start_ = edge.cycle; }
            for (std::size_t motor = 0; motor < kMotors; ++motor) { pins_[motor].take(edge, motor, start_); }
            if (edge.pin == kLightPin && edge.is_high) { ++flashes_; }
            if (is_pwm(edge.pin)) { edges_[edge.pin].push_back(edge); }
            if (is_output(edge.pin)) { outputs_[edge.pin].push_back(level_change(edge, start_)); }
        }
    }

    void measure_usb(std::size_t bytes) {
        constexpr std::size_t kSlices = 10;
        usb_bytes_.push_back(bytes);
        if (usb_bytes_.size() > kSlices) { usb_bytes_.pop_front(); }
        most_usb_bytes_ = std::max(most_usb_bytes_, std::accumulate(usb_bytes_.begin(), usb_bytes_.end(), 0UL));
    }
    void measure(std::uint32_t cycles) {
        constexpr std::size_t kSlices = 5;
        all_interrupted_ += cycles;
        interrupted_.push_back(cycles);
        if (interrupted_.size() > kSlices) { interrupted_.pop_front(); }
        const double sum = std::accumulate(interrupted_.begin(), interrupted_.end(), 0.0);
        busiest_ = std::max(busiest_, sum / (kSlices * kSlice_us * kCyclesPerTick));
    }

    EmulatedBoard board_{LOCKSTEP_BOARD_EMULATOR, LOCKSTEP_BOARD_FIRMWARE};
    std::array<BoardHost, 2> hosts_{BoardHost{1}, BoardHost{3}};  // by HostLine
    std::array<bool, 2> speaks_{true, false};
    Plug plug_ = Plug::AsItIs;
    bool is_usb_open_ = false;
    bool is_in_boot_mode_ = false;
    std::deque<std::size_t> usb_bytes_;  // that came in the last slices
    std::size_t most_usb_bytes_ = 0;
    bool is_babbling_ = false;
    std::array<PinWatch, kMotors> pins_;
    std::map<std::uint8_t, std::vector<LevelChange>> outputs_;
    std::map<std::uint8_t, std::vector<PinEdge>> edges_;  // of PWM, by pin
    int flashes_ = 0;
    std::uint32_t now_us_ = 0;
    double start_ = 0;
    std::uint32_t levels_ = 0;               // of the input pins; pin n is bit n
    std::deque<std::uint32_t> interrupted_;  // of the last slices
    double all_interrupted_ = 0;
    double busiest_ = 0;
    bool is_poor_ = false;
    std::mt19937_64 random_{1};
};

}  // namespace lockstep::testing
