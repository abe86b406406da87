#include "tests/records/random_program.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <numbers>
#include <random>

namespace lockstep::records {
namespace {

class Writer {
public:
    explicit Writer(std::uint64_t seed) : random_(seed) {}

    std::string write() {
        text_ = fmt::format("G21 G90 G17 G94 G80\n{}\nG0 X{:.0f} Y{:.0f} Z{:.0f}\n",
                            one_of({"G64", "G64 P0.05", "G61", "G61.1"}), x_, y_, z_);
        const int parts = 2 + static_cast<int>(random_() % 4);
        for (int i = 0; i < parts; ++i) { add_part(); }
        return text_;
    }

private:
    std::string one_of(std::initializer_list<const char*> choices) {
        return *(choices.begin() + random_() % choices.size());
    }
    double between(double low, double high) {
        return low + (high - low) * static_cast<double>(random_() % 1'000'001) * 1e-6;
    }
    double feed() { return between(900, 6000); }
    void go(double x, double y) {
        x_ = x;
        y_ = y;
    }

    void add_part() {
        switch (random_() % 7) {
            case 0: return add_line();
            case 1: return add_arc(false);
            case 2: return add_arc(true);
            case 3: return add_spline();
            case 4: return add_cycle();
            case 5: return add_short_lines();
            default: text_ += fmt::format("G4 P{:.3f}\n", between(0.01, 0.2));
        }
    }
    void add_line() {
        go(x_ + between(-6, 6), y_ + between(-6, 6));
        text_ += fmt::format("{} X{:.3f} Y{:.3f} F{:.0f}\n", one_of({"G0", "G1"}), x_, y_, feed());
    }
    /// Part of a circle from where the tool is; the helix also rises or falls, in up to three turns.
    void add_arc(bool is_helix) {
        const double radius = between(0.5, 4);
        const double from = between(0, 2 * std::numbers::pi);
        const double centre_x = x_ - radius * std::cos(from);
        const double centre_y = y_ - radius * std::sin(from);
        const double to = between(0, 2 * std::numbers::pi);
        const std::string turns = is_helix ? fmt::format(" Z{:.4f} P{}", z_ = between(8, 14), 1 + random_() % 3) : "";
        const double i = centre_x - x_;
        const double j = centre_y - y_;
        go(centre_x + radius * std::cos(to), centre_y + radius * std::sin(to));
        text_ += fmt::format("{} X{:.6f} Y{:.6f}{} I{:.6f} J{:.6f} F{:.0f}\n", one_of({"G2", "G3"}), x_, y_, turns, i,
                             j, feed());
    }
    void add_spline() {
        const double dx = between(2, 8);
        const double dy = between(-3, 3);
        text_ += fmt::format("G5 I{:.3f} J{:.3f} P{:.3f} Q{:.3f} X{:.3f} Y{:.3f} F{:.0f}\n", between(0, 2),
                             between(-3, 3), between(-2, 0), between(-3, 3), x_ + dx, y_ + dy, feed());
        go(x_ + dx, y_ + dy);
    }
    void add_cycle() {
        text_ += fmt::format("G99 {} X{:.3f} Y{:.3f} Z{:.3f} R{:.3f}{} F{:.0f}\nG80\n", "G83", x_, y_, between(4, 5),
                             7.0, " Q1", feed());
        z_ = 7;
    }
    void add_short_lines() {
        text_ += fmt::format("G1 F{:.0f}\n", feed());
        const int count = 20 + static_cast<int>(random_() % 60);
        double angle = between(0, 6);
        for (int i = 0; i < count; ++i) {
            angle += between(-0.2, 0.25);
            go(x_ + 0.08 * std::cos(angle), y_ + 0.08 * std::sin(angle));
            text_ += fmt::format("X{:.4f} Y{:.4f}\n", x_, y_);
        }
    }

    std::mt19937_64 random_;
    std::string text_;
    double x_ = 30;
    double y_ = 30;
    double z_ = 9;
};

}  // namespace

std::string random_gcode(std::uint64_t seed) { return Writer(seed).write(); }

std::string random_lines(std::uint64_t seed) {
    std::mt19937_64 random(seed);
    const auto between = [&](double low, double high) {
        return low + (high - low) * static_cast<double>(random() % 1'000'001) * 1e-6;
    };
    std::string text =
        fmt::format("G21 G90 G64{}\nG0 X60 Y60\nG1 F{:.0f}\n", seed % 3 == 0 ? " P0.05" : "", between(600, 6000));
    double x = 60;
    double y = 60;
    double angle = between(0, 2 * std::numbers::pi);
    const double longest = between(0.02, 3);
    for (int i = 0; i < 150; ++i) {
        angle += random() % 8 == 0 ? between(-3, 3) : random() % 2 == 0 ? 0 : between(-0.1, 0.1);
        const double length = longest * std::pow(0.004 / longest, between(0, 1));
        x = std::clamp(x + length * std::cos(angle), 1.0, 199.0);
        y = std::clamp(y + length * std::sin(angle), 1.0, 199.0);
        text += fmt::format("X{:.4f} Y{:.4f}\n", x, y);
    }
    return text;
}

std::string random_moves_of_one_axis(std::uint64_t seed) {
    std::mt19937_64 random(seed);
    std::string text = fmt::format("G64\nG1 F{}\n", 40 + random() % 200);
    for (int i = 0; i < 8; ++i) {
        text += fmt::format("X{:.3f}\n", 0.001 * static_cast<double>(100 + random() % 4000));
    }
    return text;
}

}  // namespace lockstep::records
