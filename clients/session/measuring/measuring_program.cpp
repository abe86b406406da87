#include "clients/session/measuring/measuring_program.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <array>
#include <cmath>

#include "clients/session/measuring/measure_words.hpp"
#include "clients/session/move_program.hpp"
#include "clients/text/format.hpp"
#include "core/enumeration.hpp"
#include "core/gcode/gcode.hpp"

namespace lockstep {
namespace {

constexpr std::array<const char*, 3> kNames{"X", "Y", "Z"};
using Place = std::array<double, 3>;
using Checked = std::expected<void, MeasureError>;

std::unexpected<MeasureError> error(std::string text) { return std::unexpected(MeasureError{{}, std::move(text)}); }

/// The text of one measurement.
class MeasuringText {
public:
    MeasuringText(const MachineConfig& machine, const std::vector<double>& start_mm, const MeasureOptions& options)
        : machine_(machine), start_mm_(start_mm), options_(options) {}

    std::expected<MeasuringProgram, MeasureError> write() {
        const auto probe = chosen_probe(machine_, options_.probe);
        if (!probe) { return error(probe.error()); }
        made_.probe = *probe;
        if (auto checked = find_axes(); !checked) { return std::unexpected(checked.error()); }
        if (auto checked = check_values(); !checked) { return std::unexpected(checked.error()); }
        made_.text = "G21 G90 G94 G17 G40 G49 G54\n";
        const auto written = write_call();
        if (!written) { return std::unexpected(written.error()); }
        return std::move(made_);
    }

private:
    Checked find_axes() {
        for (std::size_t i = 0; i < kNames.size(); ++i) {
            const auto axis = find_axis(machine_, kNames[i]);
            if (!axis) { return error(axis.error() + "; measuring needs axes X, Y and Z"); }
            axes_[i] = *axis;
            from_[i] = start_mm_[*axis];
        }
        return {};
    }

    Checked check_values() const {
        constexpr double kMostFeed = kMaxFeed_mm_s * 60 / 10;  // ways beside the work have ten times as much
        if (auto in = check_range("feed", options_.feed_mm_min, kMinFeedPerMinute, kMostFeed, "mm/min"); !in) {
            return in;
        }
        if (auto in = check_range("back", options_.back_mm, 0.01, 100, "mm"); !in) { return in; }
        return check_range("tip", options_.tip_mm, 0, 50, "mm");
    }

    Checked write_call() {
        switch (options_.kind) {
            case MeasureKind::Edge: return edge();
            case MeasureKind::Angle: return angle();
            case MeasureKind::Corner: return corner();
            case MeasureKind::Bore: return bore();
            case MeasureKind::Boss: return boss();
            case MeasureKind::Tool: return tool();
            case MeasureKind::Surface: return surface();
        }
        return {};
    }

    /// The tip may go this far from where it stands. `back`: the second touch may go a little farther than the first.
    Checked reach(std::size_t axis, double way) const {
        const AxisConfig& config = machine_.axes[axes_[axis]];
        const double to = from_[axis] + way;
        const bool is_within =
            to >= config.position_min_mm - kTravelTolerance_mm && to <= config.position_max_mm + kTravelTolerance_mm;
        if (is_within) { return {}; }
        return error(
            fmt::format("the probe could go to {}={}, outside the travel of axis {}, {} to {} mm; begin "
                        "elsewhere, or choose a shorter way",
                        config.name, fixed(to, 3), config.name, fixed(config.position_min_mm, 3),
                        fixed(config.position_max_mm, 3)));
    }
    Checked reach_all(std::initializer_list<std::pair<std::size_t, double>> ways) const {
        for (const auto& [axis, way] : ways) {
            if (auto within = reach(axis, way); !within) { return within; }
        }
        return {};
    }
    double with_back(double way) const { return way + std::copysign(options_.back_mm, way); }

    void call(std::string_view subroutine, std::initializer_list<double> arguments) {
        made_.text += fmt::format("o<measure_{}> call", subroutine);
        for (const double argument : arguments) { made_.text += fmt::format(" [{}]", fixed(argument, 6)); }
        made_.text += '\n';
    }
    double feed() const { return options_.feed_mm_min; }
    double back() const { return options_.back_mm; }
    double probe() const { return made_.probe; }

    Checked edge() {
        const auto way = one_way(options_.words);
        if (!way) { return error(way.error()); }
        if (auto within = reach(way->axis, with_back(way->mm)); !within) { return within; }
        call("edge",
             {way->axis == 0 ? way->mm : 0, way->axis == 1 ? way->mm : 0, options_.tip_mm, feed(), back(), probe(), 0});
        return {};
    }

    Checked angle() {
        const auto way = one_way(options_.words);
        if (!way) { return error(way.error()); }
        const double along = options_.along_mm;
        if (auto in = check_range("along", std::abs(along), 0.1, 1e5, "mm, or less than -0.1"); !in) { return in; }
        if (auto within = reach_all({{way->axis, with_back(way->mm)}, {1 - way->axis, along}}); !within) {
            return within;
        }
        call("angle", {way->axis == 0 ? way->mm : 0, way->axis == 1 ? way->mm : 0, along, feed(), back(), probe(), 0});
        return {};
    }

    Checked corner() {
        const auto to = both_ways(options_.words);
        if (!to) { return error(to.error()); }
        const double beside = options_.clearance_mm;
        if (auto in = check_range("beside", beside, 0.1, 1e4, "mm"); !in) { return in; }
        for (const std::size_t axis : {0U, 1U}) {
            const double way = (*to)[axis];
            const double farthest = std::max(2 * std::abs(way) + back(), std::abs(way) + beside);
            if (auto within = reach(axis, std::copysign(farthest, way)); !within) { return within; }
        }
        call("corner", {(*to)[0], (*to)[1], beside, options_.tip_mm, feed(), back(), probe(), 0});
        return {};
    }

    /// The centre may be a fifth of the diameter away.
    static constexpr double kOffCentre = 0.2;

    Checked check_diameter() const {
        if (auto in = check_range("diameter", options_.diameter_mm, 0.1, 1e4, "mm"); !in) { return in; }
        if (options_.tip_mm < options_.diameter_mm) { return {}; }
        return std::unexpected(
            MeasureError{"tip", fmt::format("is {}; it must be below the diameter, {} mm", fixed(options_.tip_mm, 3),
                                            fixed(options_.diameter_mm, 3))});
    }

    Checked bore() {
        if (auto in = check_diameter(); !in) { return in; }
        const double way = (0.75 + kOffCentre) * options_.diameter_mm;
        if (auto within = reach_all({{0, -way}, {0, way}, {1, -way}, {1, way}}); !within) { return within; }
        call("bore", {options_.diameter_mm, options_.tip_mm, feed(), back(), probe(), 0});
        return {};
    }

    Checked boss() {
        if (auto in = check_range("diameter", options_.diameter_mm, 0.1, 1e4, "mm"); !in) { return in; }
        if (auto in = check_range("down", options_.down_mm, 0.01, 1e4, "mm"); !in) { return in; }
        if (auto in = check_range("clearance", options_.clearance_mm, 0.1, 1e4, "mm"); !in) { return in; }
        const double side = (0.5 + kOffCentre) * options_.diameter_mm + options_.tip_mm / 2 + options_.clearance_mm;
        if (auto within = reach_all({{0, -side}, {0, side}, {1, -side}, {1, side}, {2, -options_.down_mm}}); !within) {
            return within;
        }
        call("boss", {options_.diameter_mm, options_.down_mm, options_.clearance_mm, options_.tip_mm, feed(), back(),
                      probe(), 0});
        return {};
    }

    Checked tool() {
        if (auto in = check_range("down", options_.down_mm, 0.01, 1e4, "mm"); !in) { return in; }
        if (auto within = reach(2, with_back(-options_.down_mm)); !within) { return within; }
        call("tool", {options_.down_mm, options_.setter_mm, feed(), back(), probe(), 0});
        return {};
    }

    Checked surface() {
        if (auto in = check_range("down", options_.down_mm, 0.01, 1e4, "mm"); !in) { return in; }
        if (auto in = check_range("spacing", options_.spacing_mm, 0.1, 1e4, "mm"); !in) { return in; }
        const auto ranges = both_ranges(options_.words);
        if (!ranges) { return error(ranges.error()); }
        SurfaceGrid grid{points((*ranges)[0]), points((*ranges)[1])};
        if (grid.x_mm.size() * grid.y_mm.size() > HeightMap::kMostPoints) {
            return std::unexpected(MeasureError{
                "spacing", fmt::format("is {} mm, which makes {} points in X and {} in Y; there can be at most {} in "
                                       "all: choose a greater one",
                                       fixed(options_.spacing_mm, 3), grid.x_mm.size(), grid.y_mm.size(),
                                       HeightMap::kMostPoints)});
        }
        for (const std::size_t axis : {0U, 1U}) {
            for (const double mm : {(*ranges)[axis].from_mm, (*ranges)[axis].to_mm}) {
                if (auto within = reach(axis, mm - from_[axis]); !within) { return within; }
            }
        }
        if (auto within = reach(2, with_back(-options_.down_mm)); !within) { return within; }
        made_.text += fmt::format("F{}\nG1 X{} Y{}\n", fixed(10 * feed(), 6), fixed(grid.x_mm.front(), 6),
                                  fixed(grid.y_mm.front(), 6));
        call("surface",
             {grid.x_mm[1] - grid.x_mm[0], static_cast<double>(grid.x_mm.size()), grid.y_mm[1] - grid.y_mm[0],
              static_cast<double>(grid.y_mm.size()), options_.down_mm, feed(), back(), probe()});
        made_.grid = std::move(grid);
        return {};
    }

    std::vector<double> points(const Range& range) const {
        const double length = range.to_mm - range.from_mm;
        const auto gaps = static_cast<std::size_t>(std::max(1.0, std::ceil(length / options_.spacing_mm - 1e-9)));
        std::vector<double> at;
        for (std::size_t i = 0; i <= gaps; ++i) {
            at.push_back(range.from_mm + length * static_cast<double>(i) / static_cast<double>(gaps));
        }
        return at;
    }

    const MachineConfig& machine_;
    const std::vector<double>& start_mm_;
    const MeasureOptions& options_;
    std::array<std::size_t, 3> axes_{};
    Place from_{};
    MeasuringProgram made_;
};

}  // namespace

std::expected<MeasuringProgram, MeasureError> measuring_program(const MachineConfig& machine,
                                                                const std::vector<double>& start_mm,
                                                                const MeasureOptions& options) {
    return MeasuringText(machine, start_mm, options).write();
}

}  // namespace lockstep
