#include "tests/simulation/simtest/draw/draw_program.hpp"

#include <algorithm>
#include <cmath>
#include <numbers>

namespace lockstep::simtest {
namespace {

constexpr double kProgramSeconds = 3;  // approximate length of a drawn program
constexpr std::int64_t kMostGroups = 8;

class ProgramDrawer {
public:
    ProgramDrawer(Draw& draw, const MachineConfig& machine) : draw_(draw), machine_(machine) {
        for (const AxisIndex i : axis_indices(machine.axes.size())) { places_.push_back(i); }
        for (std::size_t i = places_.size(); i > 1; --i) { std::swap(places_[i - 1], places_[draw.index(i)]); }
        if (draw.chance(0.2)) { places_.resize(1 + draw.index(places_.size())); }
        program_.name = "drawn";
        for (const std::size_t place : places_) {
            program_.axes.push_back(machine.axes[place].name);
            at_.push_back(draw.real(axis(at_.size()).position_min_mm, axis(at_.size()).position_max_mm));
        }
    }

    /// Continues after the last move of a program.
    ProgramDrawer(Draw& draw, const MachineConfig& machine, Program program)
        : draw_(draw), machine_(machine), program_(std::move(program)) {
        for (const std::string& name : program_.axes) {
            const auto named = std::ranges::find(machine.axes, name, &AxisConfig::name);
            places_.push_back(static_cast<std::size_t>(named - machine.axes.begin()));
        }
        for (const Block& block : program_.blocks) {
            if (const auto* move = std::get_if<ProgramMove>(&block.action)) { at_ = move->target_mm; }
        }
        moved_ = !at_.empty();
    }

    Program with_dense_curve() {
        if (moved_) { dense_curve(); }
        return std::move(program_);
    }
    /// Puts path modes, fixed feeds and events between the blocks, and arcs after the last one.
    Program with_curves() {
        std::vector<Block> blocks;
        std::swap(blocks, program_.blocks);
        for (Block& block : blocks) {
            if (draw_.chance(0.1)) { modes(); }
            if (draw_.chance(0.1)) { events(block.line); }
            if (auto* move = std::get_if<ProgramMove>(&block.action)) { give_modes(*move); }
            program_.blocks.push_back(std::move(block));
        }
        if (moved_ && machine_.coordination != StepMethod::Lai) {
            modes();
            arcs();
        }
        return std::move(program_);
    }
    Program take() {
        for (std::int64_t groups = draw_.whole(1, kMostGroups); groups > 0 && seconds_ < kProgramSeconds; --groups) {
            group();
        }
        return std::move(program_);
    }

private:
    const AxisConfig& axis(std::size_t i) const { return machine_.axes[places_[i]]; }
    double step_mm(std::size_t i) const { return 1 / axis(i).steps_per_mm; }
    double inside(std::size_t i, double mm) const {
        return std::clamp(mm, axis(i).position_min_mm, axis(i).position_max_mm);
    }

    void group() {
        switch (draw_.index(9)) {
            case 0:
            case 1: return anywhere();
            case 2: return reversal();
            case 3: return single_steps();
            case 4: return polyline();
            case 5: return zigzag();
            case 6: return from_end_to_end();
            case 7: return add(Dwell{draw_.chance(0.3) ? 1e-6 : draw_.magnitude(1e-4, 0.2)});
            default: return draw_.chance(0.5) ? add(Pause{}) : move(at_, true);  // or a move to the current position
        }
    }

    void anywhere() {
        std::vector<double> to = at_;
        for (std::size_t i = 0; i < to.size(); ++i) {
            if (draw_.chance(0.7)) { to[i] = draw_.real(axis(i).position_min_mm, axis(i).position_max_mm); }
        }
        move(to, draw_.chance(0.5));
    }

    void reversal() {
        const std::vector<double> from = at_;
        anywhere();
        move(from, draw_.chance(0.5));
    }

    void single_steps() {
        for (std::int64_t n = draw_.whole(1, 6); n > 0; --n) {
            std::vector<double> to = at_;
            const std::size_t i = draw_.index(to.size());
            to[i] = inside(i, to[i] + step_mm(i) * static_cast<double>(draw_.whole(-3, 3)));
            move(to, draw_.chance(0.5));
        }
    }

    /// A curve of two axes as a polyline, with chords of a few steps or many.
    void polyline() {
        const std::size_t a = draw_.index(at_.size());
        const std::size_t b = draw_.index(at_.size());
        const double chord = draw_.magnitude(1, 400);
        const double bend = draw_.real(-0.6, 0.6);
        const bool rapid = draw_.chance(0.3);
        double heading = draw_.real(0, 2 * std::numbers::pi);
        for (std::int64_t n = draw_.whole(5, 40); n > 0; --n, heading += bend) {
            std::vector<double> to = at_;
            to[a] = inside(a, to[a] + chord * step_mm(a) * std::cos(heading));
            to[b] = inside(b, to[b] + chord * step_mm(b) * std::sin(heading));
            move(to, rapid);
        }
    }

    /// A smooth curve of two axes, or a line, cut into chords of a fraction of a step and more.
    void dense_curve() {
        const std::size_t a = draw_.index(at_.size());
        const std::size_t b = draw_.index(at_.size());
        const double chord = draw_.magnitude(0.1, 30);
        const double bend = draw_.chance(0.3) ? 0 : draw_.real(-0.1, 0.1);
        const bool rapid = draw_.chance(0.3);
        double heading = draw_.real(0, 2 * std::numbers::pi);
        for (std::int64_t n = draw_.whole(50, 1500); n > 0 && seconds_ < kProgramSeconds; --n, heading += bend) {
            std::vector<double> to = at_;
            to[a] = inside(a, to[a] + chord * step_mm(a) * std::cos(heading));
            to[b] = inside(b, to[b] + chord * step_mm(b) * std::sin(heading));
            move(to, rapid);
        }
    }

    void modes() {
        mode_ = draw_.chance(0.6) ? PathMode::Blend : draw_.chance(0.5) ? PathMode::ExactPath : PathMode::ExactStop;
        tolerance_mm_ = draw_.chance(0.3) ? draw_.magnitude(1e-3, 0.1) : 0;
        is_feed_fixed_ = draw_.chance(0.2);
    }
    void give_modes(ProgramMove& move) const {
        move.mode = mode_;
        move.tolerance_mm = mode_ == PathMode::Blend ? tolerance_mm_ : 0;
        move.is_feed_fixed = is_feed_fixed_;
    }
    static constexpr std::size_t kWithoutPlaces = static_cast<std::size_t>(ProgramEvent::Kind::PulseSpacing);
    void events(std::optional<std::int32_t> line) {
        for (std::int64_t n = draw_.whole(1, 3); n > 0; --n) {
            ProgramEvent event{.kind = static_cast<ProgramEvent::Kind>(draw_.index(kWithoutPlaces))};
            event.index = static_cast<std::int32_t>(draw_.index(5));
            program_.blocks.push_back({line, event});
        }
    }

    /// Arcs, helices and whole turns of two axes. Each begins where the previous one ends.
    void arcs() {
        if (at_.size() < 2) { return; }
        const std::size_t a = draw_.index(at_.size());
        const std::size_t b = (a + 1 + draw_.index(at_.size() - 1)) % at_.size();
        for (std::int64_t n = draw_.whole(1, 6); n > 0; --n) { arc(a, b); }
    }

    void arc(std::size_t a, std::size_t b) {
        const double angle = draw_.real(0, 2 * std::numbers::pi);
        const double radius = draw_.magnitude(0.3, 2000) * std::max(step_mm(a), step_mm(b));
        const double x = at_[a] - radius * std::cos(angle);
        const double y = at_[b] - radius * std::sin(angle);
        const bool is_inside = x - radius >= axis(a).position_min_mm && x + radius <= axis(a).position_max_mm &&
                               y - radius >= axis(b).position_min_mm && y + radius <= axis(b).position_max_mm;
        if (!is_inside || radius < 1e-3) { return anywhere(); }
        std::vector<double> to = at_;
        const double sweep = draw_.chance(0.2) ? 2 * std::numbers::pi : draw_.real(0.05, 6.2);
        const bool is_clockwise = draw_.chance(0.5);
        if (sweep < 2 * std::numbers::pi) {
            to[a] = inside(a, x + radius * std::cos(angle + (is_clockwise ? -sweep : sweep)));
            to[b] = inside(b, y + radius * std::sin(angle + (is_clockwise ? -sweep : sweep)));
        }
        for (std::size_t i = 0; i < to.size(); ++i) {
            if (i != a && i != b && draw_.chance(0.2)) { to[i] = inside(i, to[i] + draw_.real(-5, 5) * step_mm(i)); }
        }
        const double way = sweep * radius;
        const double fastest = std::min(axis(a).max_velocity_mm_s, axis(b).max_velocity_mm_s);
        const double feed = std::clamp(fastest * draw_.magnitude(0.05, 2), std::max(1e-3, way / 1.5), kMaxFeed_mm_s);
        ProgramMove move{.target_mm = to, .feed_mm_s = feed, .arc = ArcShape{.first = a, .second = b}};
        move.arc->centre_first_mm = x;
        move.arc->centre_second_mm = y;
        move.arc->is_clockwise = is_clockwise;
        give_modes(move);
        add(std::move(move));
        seconds_ += way / std::min(feed, fastest);
        at_ = to;
    }

    /// Sharp corners, each a short distance from the previous one.
    void zigzag() {
        const double width = draw_.magnitude(1, 2000);
        for (std::int64_t n = draw_.whole(2, 12); n > 0; --n) {
            std::vector<double> to = at_;
            for (std::size_t i = 0; i < to.size(); ++i) {
                to[i] = inside(i, to[i] + draw_.real(-width, width) * step_mm(i));
            }
            move(to, draw_.chance(0.7));
        }
    }

    void from_end_to_end() {
        std::vector<double> to = at_;
        const std::size_t i = draw_.index(to.size());
        to[i] = draw_.chance(0.5) ? axis(i).position_min_mm : axis(i).position_max_mm;
        move(to, draw_.chance(0.7));
    }

    /// A feed below, at or above the machine's maximum, but not so slow that nothing else happens. The first
    /// move starts at any position. It is rapid, because a feed would apply to another distance.
    void move(const std::vector<double>& to, bool is_rapid) {
        const bool rapid = is_rapid || !moved_;
        moved_ = true;
        double least_s = 1e-6;
        double square = 0;
        for (std::size_t i = 0; i < to.size(); ++i) {
            const double mm = to[i] - at_[i];
            least_s = std::max(least_s, std::abs(mm) / axis(i).max_velocity_mm_s);
            square += mm * mm;
        }
        const double slower = rapid ? 1 : draw_.magnitude(0.5, std::max(1.0, std::min(30.0, 1.5 / least_s)));
        const double feed = std::sqrt(square) / (least_s * slower);
        add(ProgramMove{to, rapid ? 0 : std::clamp(feed, 1e-3, kMaxFeed_mm_s), rapid});
        seconds_ += least_s * slower;
        at_ = to;
    }

    template <typename Action>
    void add(Action action) {
        program_.blocks.push_back({static_cast<std::int32_t>(program_.blocks.size() + 1), std::move(action)});
    }

    Draw& draw_;
    const MachineConfig& machine_;
    std::vector<std::size_t> places_;  // the index in the machine of each axis of the program
    Program program_;
    std::vector<double> at_;
    double seconds_ = 0;
    bool moved_ = false;
    PathMode mode_ = PathMode::Blend;
    double tolerance_mm_ = 0;
    bool is_feed_fixed_ = false;
};

}  // namespace

Program draw_program(Draw& draw, const MachineConfig& machine) { return ProgramDrawer(draw, machine).take(); }

Program with_dense_curve(Draw& draw, const MachineConfig& machine, Program program) {
    return ProgramDrawer(draw, machine, std::move(program)).with_dense_curve();
}

Program with_curves(Draw& draw, const MachineConfig& machine, Program program) {
    return ProgramDrawer(draw, machine, std::move(program)).with_curves();
}

}  // namespace lockstep::simtest
