#include "tests/property/machines/random_machine.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <random>
#include <vector>

#include "core/units.hpp"

namespace lockstep {
namespace {

class Draw {
public:
    explicit Draw(std::uint64_t seed) : random_(seed) {}

    bool chance(double probability) { return uniform(0, 1) < probability; }
    std::int64_t integer(std::int64_t low, std::int64_t high) {
        return low + static_cast<std::int64_t>(random_() % static_cast<std::uint64_t>(high - low + 1));
    }
    double uniform(double low, double high) {
        return low + (high - low) * (static_cast<double>(random_() >> 11) * 0x1p-53);
    }
    double log_uniform(double low, double high) {
        return low >= high ? low : low * std::pow(high / low, uniform(0, 1));
    }
    /// Mostly within [low, high], sometimes one of them.
    double spread(double low, double high) {
        const double kind = uniform(0, 1);
        return kind < 0.08 ? low : kind < 0.16 ? high : log_uniform(low, high);
    }
    template <typename T>
    const T& one_of(const std::vector<T>& choices) {
        return choices[random_() % choices.size()];
    }

private:
    std::mt19937_64 random_;
};

/// The values of one axis, which suit each other at first.
struct AxisValues {
    double steps_per_mm = 0, start = 0, top = 0, accel = 0, decel = 0, min = 0, max = 0;
    double search = 0, latch = 0, pulloff = 0, at = 0, park = 0, tolerance = 0;
    double slide = 0, margin = 0, torque = 0, jump = 0;
    bool toward_min = true;
    std::string method;
};

class Writer {
public:
    explicit Writer(std::uint64_t seed) : draw_(seed) {}

    std::string write() {
        const bool is_lai = draw_.chance(0.12);
        tick_ns_ = draw_.chance(0.4) ? 1000
                   : is_lai          ? draw_.one_of<std::int64_t>({100, 1000, 10'000, 50'000, 100'000, 500'000})
                            : draw_.one_of<std::int64_t>({100, 125, 200, 250, 500, 800, 1250, 2000, 5000, 10'000,
                                                          20'000, 50'000, 100'000, 1'000'000});
        const auto axes = static_cast<std::size_t>(draw_.integer(is_lai ? 2 : 1, draw_.chance(0.1) ? 6 : 3));
        std::string text = fmt::format("name: \"m\"\ntick_ns: {}\n", tick_ns_);
        text += timing();
        if (is_lai) { text += "coordination: LAI\n"; }
        for (std::size_t i = 0; i < axes; ++i) { text += axis(i, is_lai); }
        return text;
    }

private:
    std::string timing() {
        if (draw_.chance(0.5)) { return ""; }
        const std::int64_t whole = std::max<std::int64_t>(1, tick_ns_ / 1000);
        std::int64_t slot_us = std::llround(draw_.spread(500, draw_.chance(0.1) ? 1e6 : 20'000));
        slot_us = std::max(slot_us / whole, (499 + whole) / whole) * whole;
        if (tick_ns_ % 1000 != 0 && 1000 % tick_ns_ != 0) { slot_us = (slot_us + 3) / 4 * 4; }
        const std::int64_t stall = draw_.chance(0.1) ? draw_.integer(1, 200) : draw_.integer(1, 12);
        const std::int64_t late = draw_.integer(0, std::min<std::int64_t>(stall, 4));
        const std::int64_t fresh = std::min<std::int64_t>(250, stall + 1 + draw_.integer(0, 3));
        const std::int64_t ahead = fresh + stall + late + 8 + draw_.integer(0, 4);
        const std::int64_t frame =
            draw_.chance(0.1) ? draw_.integer(1, 10'000) : ahead / draw_.integer(1, 9) + 1 + draw_.integer(0, 3);
        const std::string source = draw_.chance(0.2) ? " time_source: NETWORK" : "";
        return fmt::format(
            "timing {{ slot_us: {} stall_slots: {} late_check_slots: {} freshness_slots: {} send_ahead_slots: {} "
            "frame_slots: {}{} }}\n",
            slot_us, stall, late, fresh, ahead, frame, source);
    }

    std::string axis(std::size_t index, bool is_lai) {
        AxisValues v = suitable(is_lai);
        std::string keys;
        homing_of(v);
        plant_of(v);
        spoil(v);
        const auto key = [&](const char* name, double value) { keys += fmt::format("  {}: {}\n", name, value); };
        static const std::vector<std::string> kNames{"X", "Y", "Z", "A", "B", "C", "U", "V", "W"};
        keys += fmt::format("axis {{\n  name: \"{}\"\n", kNames[(index + first_name_) % kNames.size()]);
        key("steps_per_mm", v.steps_per_mm);
        key("start_velocity_mm_s", v.start);
        key("max_velocity_mm_s", v.top);
        key("max_accel_mm_s2", v.accel);
        if (v.decel != v.accel) { key("max_decel_mm_s2", v.decel); }
        key("position_min_mm", v.min);
        key("position_max_mm", v.max);
        if (!v.method.empty()) { keys += "  method: " + v.method + "\n"; }
        keys += "  homing {\n";
        if (!v.toward_min) { keys += "  toward_min: false\n"; }
        const auto maybe = [&](const char* name, double value) {
            if (draw_.chance(0.75)) { key(name, value); }
        };
        maybe("search_velocity_mm_s", v.search);
        maybe("latch_velocity_mm_s", v.latch);
        maybe("pulloff_mm", v.pulloff);
        maybe("touch_tolerance_mm", v.tolerance);
        maybe("switch_position_mm", v.at);
        maybe("park_mm", v.park);
        keys += "  }\n  plant {\n";
        if (draw_.chance(0.95)) { key("start_position_mm", v.slide); }
        maybe("travel_margin_mm", v.margin);
        if (draw_.chance(0.2)) { key("max_torque_accel_mm_s2", v.torque); }
        if (draw_.chance(0.2)) { key("max_jump_mm_s", v.jump); }
        return keys + "  }\n}\n";
    }

    AxisValues suitable(bool is_lai) {
        AxisValues v;
        const double tick_s = static_cast<double>(tick_ns_) * 1e-9;
        v.steps_per_mm = draw_.chance(0.5) ? draw_.spread(1e-3, 1e6) : draw_.spread(1, 2000);
        const double fastest = std::min(1e6, kMaxPlannedStepsPerTick / tick_s / v.steps_per_mm);
        const double slowest =
            std::min(fastest, std::max(draw_.chance(0.1) ? 1e-3 : 6e-3, draw_.chance(0.1) ? 0 : 1 / v.steps_per_mm));
        v.top = draw_.spread(slowest, fastest);
        v.start = draw_.chance(0.1) ? v.top : std::max(1e-3, v.top * draw_.log_uniform(1e-4, 1));
        const double most = std::min(1e9, 0.5 / tick_s / tick_s / v.steps_per_mm);
        v.accel = draw_.chance(0.7) ? std::clamp(v.top / draw_.spread(1e-3, 60), 1e-3, most)
                                    : draw_.spread(std::clamp(v.top / 600, 1e-3, most), most);
        v.decel = draw_.chance(0.5) ? v.accel
                                    : std::clamp(v.accel * draw_.spread(0.1, 10), std::max(1e-3, v.top / 600), most);
        if (draw_.chance(0.5)) {
            v.method = draw_.one_of<std::string>({"RANADE", "SPIELAUER", "LAI", "LAM", "CARRICA"});
        }
        if ((v.method == "LAM" || v.method == "CARRICA") && draw_.chance(0.9)) {
            v.decel = v.accel;
            v.start = std::max(v.start, std::min(v.top, std::sqrt(2 * v.accel / v.steps_per_mm)));
        }
        if ((is_lai || v.method == "LAI") && draw_.chance(0.95)) {
            const double pulse = 2 / v.steps_per_mm / 0.0065;
            v.start = std::max(v.start, pulse * draw_.spread(1, 5));
            v.top = std::max(v.top, v.start);
            v.accel = std::max(v.accel, pulse / 0.0065 * draw_.spread(1, 5));
            v.decel = std::max(v.decel, v.accel);
        }
        double travel = draw_.chance(0.15) ? draw_.spread(1 / v.steps_per_mm, 1e6)
                                           : std::max(3 / v.steps_per_mm, draw_.spread(v.top * 0.1, v.top * 100));
        v.min = draw_.chance(0.5) ? 0 : -travel * draw_.uniform(0, 1.5);
        travel = std::min(travel, 4e5);
        v.min = std::max(v.min, -9e5);
        v.max = v.min + travel;
        if (draw_.chance(0.3)) {  // on round places
            v.min = std::round(v.min);
            v.max = std::max(v.min + 1, std::round(v.max));
        }
        return v;
    }

    /// Homing that does not take long: the slide begins near the switch.
    void homing_of(AxisValues& v) {
        v.toward_min = draw_.chance(0.6);
        const double step = 1 / v.steps_per_mm;
        const double travel = v.max - v.min;
        v.search = std::max(1e-3, v.start * draw_.spread(0.1, 1));
        v.latch = std::max(1e-3, v.search * draw_.spread(0.05, 1));
        v.pulloff = std::clamp(draw_.spread(step, v.latch * 2), step, std::max(step, travel * 0.9));
        v.tolerance = v.pulloff * draw_.spread(0.01, 0.99);
        v.margin = draw_.chance(0.5) ? 2 : draw_.spread(draw_.chance(0.3) ? 1e-9 : step * 0.1, std::max(step, travel));
        const double inward = draw_.chance(0.5)   ? 0
                              : draw_.chance(0.5) ? travel / 2 * draw_.uniform(0, 1)
                                                  : -v.margin * draw_.uniform(0, 0.99);
        v.at = v.toward_min ? v.min + inward : v.max - inward;
        const double away = std::min(travel * draw_.uniform(0, 1), draw_.spread(v.top * 0.01, v.top * 10));
        v.park = std::clamp(v.toward_min ? v.at + away : v.at - away, v.min, v.max);
    }

    void plant_of(AxisValues& v) {
        const double far = v.search * draw_.log_uniform(0.01, 10);
        const double low = v.min - v.margin * 0.9;
        const double high = v.max + v.margin * 0.9;
        v.slide = draw_.chance(0.05) ? draw_.uniform(low, high)
                                     : std::clamp(v.toward_min ? v.at + far : v.at - far, low, high);
        v.torque = std::max(v.accel, v.decel) * draw_.spread(1.2, 10);
        v.jump = v.start * draw_.spread(1.2, 10);
    }

    /// Replaces few values by any of the key's range.
    void spoil(AxisValues& v) {
        const auto maybe = [&](double& value, double low, double high) {
            if (draw_.chance(0.008)) { value = draw_.spread(low, high); }
        };
        for (double* speed : {&v.start, &v.top, &v.search, &v.latch}) { maybe(*speed, 1e-3, 1e6); }
        for (double* accel : {&v.accel, &v.decel}) { maybe(*accel, 1e-3, 1e9); }
        for (double* length : {&v.pulloff, &v.tolerance, &v.margin}) { maybe(*length, 1e-9, 1e6); }
        for (double* place : {&v.min, &v.max, &v.at, &v.park, &v.slide}) {
            maybe(*place, 1e-6, 1e6);
            if (draw_.chance(0.004)) { *place = -*place; }
            if (draw_.chance(0.01)) { *place = std::round(*place * 1000) / 1000; }
        }
        maybe(v.steps_per_mm, 1e-3, 1e6);
    }

    Draw draw_;
    std::int64_t tick_ns_ = 1000;
    std::size_t first_name_ = static_cast<std::size_t>(draw_.integer(0, 8));
};

}  // namespace

std::string random_machine(std::uint64_t seed) { return Writer(seed).write(); }

}  // namespace lockstep
