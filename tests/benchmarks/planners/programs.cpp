#include "tests/benchmarks/planners/programs.hpp"

#include <algorithm>
#include <cmath>
#include <cstdint>
#include <numbers>
#include <random>
#include <utility>

#include "clients/planning/plan_summary.hpp"
#include "services/documents/program_file.hpp"

namespace lockstep::planners {
namespace {

constexpr double kFeed = 100;  // mm/s
constexpr double kFineChord_mm = 0.1;

double thousandth(double mm) { return std::round(mm * 1000) / 1000; }

/// Places are rounded as CAM programs write them.
class PathMaker {
public:
    explicit PathMaker(std::vector<double> start) {
        program_.axes = {"X", "Y", "Z"};
        program_.start_mm = std::move(start);
    }
    void go(double x, double y, double z) {
        ProgramMove move{.target_mm = {thousandth(x), thousandth(y), thousandth(z)}, .feed_mm_s = kFeed};
        program_.blocks.push_back({static_cast<std::int32_t>(program_.blocks.size() + 1), std::move(move)});
    }
    NamedProgram named(const std::string& name) && {
        program_.name = name;
        return {name, std::move(program_)};
    }

private:
    Program program_;
};

NamedProgram line(const std::string& name, double mm, double part) {
    PathMaker path({10, 10, 30});
    const int parts = static_cast<int>(std::lround(mm / part));
    for (int k = 1; k <= parts; ++k) { path.go(10 + 0.8 * mm * k / parts, 10 + 0.6 * mm * k / parts, 30); }
    return std::move(path).named(name);
}

/// Two turns, in chords with middles `error_mm` inside the circle.
NamedProgram circle(const std::string& name, double radius, double error_mm) {
    PathMaker path({100 + radius, 100, 30});
    const double all = 4 * std::numbers::pi;
    const int parts = static_cast<int>(std::ceil(all / (2 * std::acos(1 - error_mm / radius))));
    for (int k = 1; k <= parts; ++k) {
        const double angle = all * k / parts;
        path.go(100 + radius * std::cos(angle), 100 + radius * std::sin(angle), 30);
    }
    return std::move(path).named(name);
}

/// A hundred moves of up to `size` in X and Y each, and a tenth of it in Z, within travel.
NamedProgram corners(const std::string& name, double size) {
    std::mt19937_64 random(1);
    const auto next = [&](double at, double reach, double most) {
        const double way = reach * (static_cast<double>(random() >> 11) * 0x1p-52 - 1);
        return at + way < 1 || at + way > most - 1 ? at - way : at + way;
    };
    double x = 100;
    double y = 100;
    double z = 30;
    PathMaker path({x, y, z});
    for (int k = 0; k < 100; ++k) {
        x = next(x, size, 200);
        y = next(y, size, 200);
        z = next(z, size / 10, 60);
        path.go(x, y, z);
    }
    return std::move(path).named(name);
}

bool has_arcs(const Program& program) {
    return std::ranges::any_of(program.blocks, [](const Block& block) {
        const auto* move = std::get_if<ProgramMove>(&block.action);
        return move != nullptr && move->arc.has_value();
    });
}

}  // namespace

std::vector<NamedProgram> simple_paths() {
    return {line("a line of 200 mm", 200, 200),
            line("the same in parts of 0.05 mm", 200, 0.05),
            circle("a circle of 5 mm radius, twice, chords of 5 um error", 5, 0.005),
            circle("a circle of 20 mm radius", 20, 0.005),
            circle("a circle of 60 mm radius", 60, 0.005),
            corners("100 random corners, up to 3 mm apart", 3),
            corners("up to 10 mm apart", 10),
            corners("up to 30 mm apart", 30)};
}

std::expected<std::vector<NamedProgram>, std::string> jobs_of(const std::filesystem::path& folder,
                                                              const MachineSetup& machine) {
    std::vector<NamedProgram> jobs;
    for (const std::string name : {"engraving", "surface", "pocket", "print", "threads", "raster"}) {
        const auto file = folder / (name + ".gcode");
        auto program = load_gcode_file(file, machine, parked_mm(machine));
        if (!program) {
            const Diagnostic& first = program.error().front();
            return std::unexpected(file.string() + ":" + std::to_string(first.line) + ": " + first.message);
        }
        const std::string row = name == "raster" ? "raster, its begin" : name;
        const bool is_cut = has_arcs(*program);
        jobs.push_back({row, *std::move(program)});
        if (!is_cut) { continue; }
        NamedProgram fine = jobs.back();
        fine.name += ", Klipper's arcs in chords of 0.1 mm";
        fine.klipper_chord_mm = kFineChord_mm;
        jobs.push_back(std::move(fine));
    }
    return jobs;
}

}  // namespace lockstep::planners
