// sim_fpga/rtl/lai with the host that downloads lines to it.
#pragma once

#include <array>
#include <cmath>
#include <cstdint>
#include <deque>
#include <span>
#include <vector>

#include "Vtwo_axis_controller.h"
#include "core/methods/lai_dda.hpp"
#include "tests/rtl/clocked.hpp"

namespace lockstep::rtl {

inline constexpr double kClocksPerBit = 8;  // as the tests' hardware

/// A serial line: bytes of eight bits, no parity, one stop bit.
class Serial {
public:
    explicit Serial(double clocks_per_bit = kClocksPerBit) : clocks_per_bit_(clocks_per_bit) {}

    void send(std::uint8_t byte, bool stop_bit = true) {
        bits_.push_back(false);
        for (int i = 0; i < 8; ++i) { bits_.push_back((byte >> i & 1) != 0); }
        bits_.push_back(stop_bit);
    }
    bool idle() const { return bits_.empty(); }
    /// The level in the next clock.
    bool clock() {
        if (bits_.empty()) { return true; }
        const bool level = bits_.front();
        now_ += 1;
        if (now_ >= clocks_per_bit_) {
            now_ -= clocks_per_bit_;
            bits_.pop_front();
        }
        return level;
    }

private:
    double clocks_per_bit_;
    double now_ = 0;
    std::deque<bool> bits_;
};

/// The bytes of a line (sim_fpga/rtl/lai/line_download.v).
inline std::array<std::uint8_t, 6> bytes_of(methods::PeriodPulses line) {
    const auto byte = [](std::int64_t value, int shift) { return static_cast<std::uint8_t>(value >> shift); };
    std::array<std::uint8_t, 6> bytes{0x4c, byte(line.x, 8), byte(line.x, 0), byte(line.y, 8), byte(line.y, 0), 0};
    for (std::size_t i = 0; i < 5; ++i) { bytes[5] = static_cast<std::uint8_t>(bytes[5] - bytes[i]); }
    return bytes;
}

struct LaiSettings {
    std::int64_t max = 4;
    methods::LaiRounding rounding = methods::LaiRounding::FromTheStart;
    methods::LaiCompensation compensation{};
};

/// The pulses of one clock of the DDAs: +1, -1 or 0.
using DdaClock = methods::PeriodPulses;

class LaiMachine {
public:
    static constexpr int kLongest = 50'000'000;  // clocks of a run

    explicit LaiMachine(const LaiSettings& settings) {
        auto& pins = hardware_.pins;
        pins.serial = 1;
        pins.v_max = static_cast<std::uint8_t>(settings.max);
        pins.round_each = settings.rounding == methods::LaiRounding::InEachPeriod;
        pins.derivative = settings.compensation.derivative;
        pins.limit_remaining = settings.compensation.remaining;
        hardware_.reset();
    }

    /// Downloads the lines one after the other. Calls on_clock(pins) after every clock. Returns the pulses of every
    /// clock of the DDAs, from the first period with pulses to the last one.
    template <typename OnClock>
    std::vector<DdaClock> run(std::span<const methods::PeriodPulses> lines, OnClock&& on_clock) {
        auto& pins = hardware_.pins;
        std::vector<DdaClock> clocks;
        std::vector<DdaClock> period;
        int quiet = 0;  // periods without a pulse
        for (int clock = 0; quiet < 3 && clock < kLongest; ++clock) {
            if (!lines.empty() && serial_.idle() && pins.line_waits == 0) {
                for (const std::uint8_t byte : bytes_of(lines.front())) { serial_.send(byte); }
                lines = lines.subspan(1);
            }
            pins.serial = serial_.clock();
            const bool clocked = pins.dda_clock != 0;
            const std::int64_t x = pins.x_backward != 0 ? -1 : 1;
            const std::int64_t y = pins.y_backward != 0 ? -1 : 1;
            hardware_.clock();
            on_clock(pins);
            if (!clocked) { continue; }
            period.push_back({pins.x_pulse != 0 ? x : 0, pins.y_pulse != 0 ? y : 0});
            if (pins.period_end == 0) { continue; }
            const bool moved = period != std::vector<DdaClock>(period.size());
            quiet = moved ? 0 : quiet + 1;
            if (moved || !clocks.empty()) { clocks.insert(clocks.end(), period.begin(), period.end()); }
            period.clear();
        }
        while (!clocks.empty() && clocks.back() == DdaClock{}) { clocks.pop_back(); }
        return clocks;
    }
    std::vector<DdaClock> run(std::span<const methods::PeriodPulses> lines) {
        return run(lines, [](const auto&) {});
    }

private:
    Clocked<Vtwo_axis_controller> hardware_;
    Serial serial_;
};

/// The same by core/methods.
inline std::vector<DdaClock> lai_clocks(std::span<const methods::PeriodPulses> lines, const LaiSettings& settings) {
    std::vector<DdaClock> clocks;
    methods::Dda x;
    methods::Dda y;
    for (const auto& line : lines) {
        for (const auto& period :
             methods::plan_two_axes(line, {0, settings.max, 1}, settings.rounding, settings.compensation)) {
            x.load(std::abs(period.x));
            y.load(std::abs(period.y));
            for (int i = 0; i < methods::kDdaClocks; ++i) {
                clocks.push_back({x.clock() ? (line.x < 0 ? -1 : 1) : 0, y.clock() ? (line.y < 0 ? -1 : 1) : 0});
            }
        }
    }
    while (!clocks.empty() && clocks.back() == DdaClock{}) { clocks.pop_back(); }
    return clocks;
}

}  // namespace lockstep::rtl
