// Draws the waveforms of the papers' figures from the simulated hardware: Lam Fig. 7, Carrica Fig. 4, Lai Fig. 12.
// Usage: rtl_pictures DIRECTORY
#include <filesystem>
#include <fstream>
#include <functional>
#include <string>
#include <vector>

#include "Vlam_controller.h"
#include "clients/drawing/figure.hpp"
#include "tests/rtl/carrica/motor.hpp"
#include "tests/rtl/lai/machine.hpp"

namespace lockstep::rtl {
namespace {

using drawing::Chart;
using drawing::Figure;
using drawing::Series;
using drawing::Stroke;

/// A value that changes in steps, as a curve with vertical edges.
class Trace {
public:
    Trace(std::string label, std::size_t colour, double offset = 0, bool dashed = false)
        : offset_(offset),
          series_{.label = std::move(label),
                  .stroke = {.colour = drawing::palette::series(colour), .width = 1.2, .dashed = dashed}} {}

    void add(double time, double value) {
        value += offset_;
        if (!series_.x.empty() && series_.y.back() != value) { point(time, series_.y.back()); }
        if (series_.x.empty() || series_.y.back() != value) { point(time, value); }
        last_ = time;
    }
    Series curve() && {
        if (!series_.y.empty()) { point(last_, series_.y.back()); }
        return std::move(series_);
    }

private:
    void point(double x, double y) {
        series_.x.push_back(x);
        series_.y.push_back(y);
    }

    double offset_;
    double last_ = 0;
    Series series_;
};

Chart chart(std::string title, std::string y_label, std::vector<Trace> traces) {
    Chart chart{.title = std::move(title), .y_label = std::move(y_label)};
    for (Trace& trace : traces) { chart.series.push_back(std::move(trace).curve()); }
    return chart;
}

/// Lam, Fig. 7: the head stands at 0, and 328 is latched.
Figure lam_figure7() {
    constexpr double kClockMs = 0.1;
    Clocked<Vlam_controller> hardware;
    auto& pins = hardware.pins;
    hardware.reset();
    pins.left_limit = 1;
    hardware.clock();
    pins.left_limit = 0;
    do { hardware.clock(); } while (pins.state != 1);
    pins.data_ready = 1;
    pins.destination = 0;
    hardware.clock();
    pins.data_ready = 0;
    do { hardware.clock(); } while (pins.state != 1);

    Trace pulse("", 0);
    Trace request("", 1);
    Trace delay("", 2);
    Trace location("", 3);
    int pulses = 0;
    for (int clock = 0; clock < 50 || pins.state != 1; ++clock) {
        pins.data_ready = clock == 20;
        pins.destination = 328;
        const double time = clock * kClockMs;
        request.add(time, pins.data_ready);
        hardware.clock();
        pulse.add(time, pins.pulse);
        delay.add(time, pins.state == 1 ? 0 : pins.delay);
        location.add(time, pins.location);
        pulses += pins.pulse;
    }
    return {
        .title = "Lam and Ehkan, Fig. 7, by sim_fpga/rtl/lam",
        .subtitle = std::to_string(pulses) + " pulses from the origin, the clock has 10 kHz",
        .x_label = "time, ms",
        .rows = {chart("Data_Rdy", "level", {std::move(request)}), chart("stepper pulse", "level", {std::move(pulse)}),
                 chart("the wait between pulses", "clocks", {std::move(delay)}),
                 chart("current_location_reg", "pulses", {std::move(location)})}};
}

/// Carrica, Fig. 4: V_max is one step in each T_c, V_min a seventh of it.
Figure carrica_figure4() {
    constexpr double kClock_s = 1.0 / 1024;
    const StepMove move{1'600, 1024.0 / 7, 1024, 900, 900};
    auto steps =
        *methods::CarricaSteps::of(move, methods::Fit::Exact, {.clock_s = kClock_s, .fraction_bits = kCarricaFraction});
    CarricaMotor motor;
    Trace made("commanded: V_max/n", 0);
    Series reference{.label = "V_ref", .stroke = {.colour = drawing::palette::series(1), .dashed = true}};
    std::int64_t before = 0;
    for (const std::int64_t period : motor.move(steps.reference(), move.steps, [](const auto&) {})) {
        const double n = static_cast<double>(period - before);
        made.add(static_cast<double>(before) * kClock_s, 1 / n);
        made.add(static_cast<double>(period) * kClock_s, 1 / n);
        before = period;
        reference.x.push_back(steps.next_s());
        reference.y.push_back(static_cast<double>(steps.reference().speed) /
                              static_cast<double>(steps.reference().one));
    }
    Chart speed = chart("", "speed / V_max", {std::move(made)});
    speed.series.push_back(std::move(reference));
    return {.title = "Carrica, Funes and González, Fig. 4, by sim_fpga/rtl/carrica",
            .subtitle = std::to_string(move.steps) + " steps; n = 7, 6, 5, 4, 3, 2, 1 periods of the clock for a step",
            .x_label = "time, s",
            .rows = {std::move(speed)}};
}

/// Lai, Fig. 12: the pulses of both axes and the phases that the drive makes of them, on the line {(1,0), (5,5)}.
Figure lai_figure12() {
    constexpr double kDdaClockMs = 6.5 / methods::kDdaClocks;
    constexpr int kShown = 8 * methods::kDdaClocks;
    const std::vector<methods::PeriodPulses> line{{40, 50}};
    std::vector<Trace> traces;
    traces.emplace_back("sAx0Puls", 0, 14);
    for (int i = 3; i >= 0; --i) { traces.emplace_back(i == 3 ? "Step0Out[3:0]" : "", 1, 9.0 + i * 1.2); }
    traces.emplace_back("sAx1Puls", 2, 7);
    for (int i = 3; i >= 0; --i) { traces.emplace_back(i == 3 ? "Step1Out[3:0]" : "", 3, 2.0 + i * 1.2); }
    traces.emplace_back("axis 3, not activated", 4, 0);
    int clocks = -1;
    bool clocked = false;
    (void)LaiMachine({}).run(line, [&](const auto& pins) {
        if (clocks < 0 && (pins.x_pulse != 0 || pins.y_pulse != 0)) { clocks = 0; }
        if (clocked && clocks >= 0 && clocks < kShown) {
            const double time = clocks * kDdaClockMs;
            std::size_t i = 0;
            traces[i++].add(time, pins.x_pulse);
            for (int phase = 3; phase >= 0; --phase) { traces[i++].add(time, pins.x_phases >> phase & 1); }
            traces[i++].add(time, pins.y_pulse);
            for (int phase = 3; phase >= 0; --phase) { traces[i++].add(time, pins.y_phases >> phase & 1); }
            traces[i++].add(time, 0);
            ++clocks;
        }
        clocked = pins.dda_clock != 0;
    });
    return {
        .title = "Lai, Chien and Tsao, Fig. 12, by sim_fpga/rtl/lai",
        .subtitle = "the line {(1,0), (5,5)} from its first pulse on: the DDAs' outputs and the phases of full steps",
        .x_label = "time, ms; a sampling period is 6.5 ms",
        .rows = {chart("", "signals, one above the other", std::move(traces))}};
}

}  // namespace
}  // namespace lockstep::rtl

int main(int count, char** arguments) {
    if (count != 2) { return 2; }
    const std::filesystem::path directory = arguments[1];
    const auto write = [&](const char* name, const lockstep::drawing::Figure& figure) {
        std::ofstream(directory / name) << lockstep::drawing::to_svg(figure);
    };
    write("lam-figure7.svg", lockstep::rtl::lam_figure7());
    write("carrica-figure4.svg", lockstep::rtl::carrica_figure4());
    write("lai-figure12.svg", lockstep::rtl::lai_figure12());
}
