// G73 and G81 to G89: canned cycles, as straight moves and dwells, in each plane.
#include <cmath>

#include "core/gcode/run/arc_geometry.hpp"
#include "core/gcode/run/steps.hpp"

namespace lockstep::gcode {
namespace {

constexpr double kPeckClearance_mm = 0.254;  // 0.010 inches, as in LinuxCNC
constexpr int kMostStrokes = 100'000;        // of a block: pecks times repeats

/// A cycle's heights along the plane's normal, in the program's coordinates.
struct Cycle {
    PlaneAxes axes;
    double clear = 0;  // R
    double bottom = 0;
    double retract = 0;  // where it ends
    double dwell = 0;
    double peck = 0;
    int repeats = 1;
};

/// Stores the block's word. Without one, the word of the same cycle before it holds.
Result keep_word(const Context& context, char letter, std::optional<double> word, std::optional<double>& kept) {
    if (context.state.modal.motion != context.motion) { kept.reset(); }
    if (word) { kept = word; }
    if (kept) { return {}; }
    return context.refuse_motion(std::string(" needs ") + letter +
                                 "; write it here or in an earlier block of the cycle");
}

Result check_cycle(const Context& context, PlaneAxes axes) {
    const Modal& modal = context.state.modal;
    if (context.is_compensated()) {
        return context.refuse_motion(" is not possible while cutter compensation is on; write G40 before it");
    }
    for (const char letter : std::string_view("ABCUVW")) {
        if (context.block.has(letter)) {
            return context.refuse(letter, " is not possible in a canned cycle, which moves only X, Y and Z");
        }
    }
    if (modal.feed_mode == FeedMode::InverseTime) {
        return context.refuse_motion(
            " is not possible in inverse time (G93); write G94 and a feed per minute before it");
    }
    if (!context.block.has('X') && !context.block.has('Y') && !context.block.has('Z')) {
        return context.refuse_motion(std::string(" has no position; write ") + kAxisLetters[axes.first] + " or " +
                                     kAxisLetters[axes.second]);
    }
    return check_feed(context);
}

Result read_words(Context& context, Cycle& cycle) {
    const LineWords& block = context.block;
    CycleWords& kept = context.state.cycle;
    const char normal = kAxisLetters[cycle.axes.normal];
    const auto length = [&](char letter) {
        return block.has(letter) ? std::optional(context.length(block[letter])) : std::nullopt;
    };
    if (auto done = keep_word(context, 'R', length('R'), kept.clear); !done) { return done; }
    if (auto done = keep_word(context, normal, length(normal), kept.bottom); !done) { return done; }
    if (context.motion == 820 || context.motion == 860 || context.motion == 890) {
        if (auto done = keep_word(context, 'P', block.find('P'), kept.dwell); !done) { return done; }
        if (*kept.dwell < 0) { return context.refuse('P', " s is not a dwell; it must be 0 or above"); }
        cycle.dwell = *kept.dwell;
    }
    if (context.motion == 730 || context.motion == 830) {
        if (auto done = keep_word(context, 'Q', length('Q'), kept.peck); !done) { return done; }
        if (*kept.peck <= 0) { return context.refuse('Q', " is not the depth of a peck; it must be above 0"); }
        cycle.peck = *kept.peck;
    }
    if (!block.has('L')) { return {}; }
    const auto repeats = whole(block['L']);
    if (!repeats || *repeats < 1) {
        return context.refuse('L', " is not a number of repeats; it must be a whole number from 1");
    }
    cycle.repeats = *repeats;
    return {};
}

/// R and the bottom are relative in G91: R to the height where the first cycle began, the bottom to R.
Result set_heights(Context& context, Cycle& cycle) {
    CycleWords& kept = context.state.cycle;
    const Modal& modal = context.state.modal;
    const double now = context.state.program[cycle.axes.normal];
    if (!is_cycle(modal.motion)) { kept.start = now; }
    cycle.clear = *kept.clear + (modal.relative ? kept.start : 0);
    cycle.bottom = *kept.bottom + (modal.relative ? cycle.clear : 0);
    if (cycle.clear < cycle.bottom) {
        return context.refuse_motion(" has its bottom above R; lower the bottom, or raise R");
    }
    const double strokes = cycle.peck > 0 ? (cycle.clear - cycle.bottom) / cycle.peck + 1 : 1;
    if (strokes * cycle.repeats > kMostStrokes) {
        const std::string most = " makes more than " + std::to_string(kMostStrokes);
        return cycle.repeats == 1 ? context.refuse('Q', most + " pecks; write a larger one")
                                  : context.refuse('L', most + " strokes in one block; write a smaller one");
    }
    cycle.retract = modal.retract_to_start ? std::max(kept.start, cycle.clear) : cycle.clear;
    return {};
}

class CycleRun {
public:
    CycleRun(Context& context, const Cycle& cycle) : context_(context), cycle_(cycle) {}

    void run() {
        Point place = context_.target();
        const Point from = context_.state.program;
        const Flat step = in_plane(cycle_.axes, place) - in_plane(cycle_.axes, from);
        if (height() < cycle_.clear) { go(cycle_.clear, 0); }
        for (int i = 0; i < cycle_.repeats; ++i) {
            place[cycle_.axes.normal] = height();
            move(context_, place, 0);
            go(cycle_.clear, 0);
            drill();
            go(cycle_.retract, 0);
            if (!context_.state.modal.relative) { continue; }
            const Flat next = beyond(in_plane(cycle_.axes, place), step);
            place[cycle_.axes.first] = next.x;
            place[cycle_.axes.second] = next.y;
        }
    }

private:
    /// The place of the next repeat: @ and ^ add to the distance and the angle, about the program's zero.
    Flat beyond(Flat at, Flat step) const {
        const LineWords& block = context_.block;
        if (!block.distance && !block.angle) { return at + step; }
        const double distance = length_of(at) + context_.length(block.distance.value_or(0));
        const double angle = std::atan2(at.y, at.x) + block.angle.value_or(0) / kDegrees;
        return Flat{std::cos(angle), std::sin(angle)} * distance;
    }

    double height() const { return context_.state.program[cycle_.axes.normal]; }

    void go(double to, double feed) {
        Point target = context_.state.program;
        target[cycle_.axes.normal] = to;
        move(context_, target, feed);
    }

    void drill() {
        const double feed = context_.state.modal.feed_linear;
        if (cycle_.peck > 0) { peck(feed); }
        go(cycle_.bottom, feed);
        switch (context_.motion) {
            case 820:
            case 890: context_.emit(Dwell{cycle_.dwell}); break;
            case 860: stop_for_retract(); break;
            default: break;
        }
        if (context_.motion == 850) { go(cycle_.clear, feed); }
        if (context_.motion == 890) { go(cycle_.retract, feed); }
    }

    void peck(double feed) {
        double depth = cycle_.clear - cycle_.peck;
        while (depth > cycle_.bottom) {
            go(depth, feed);
            if (context_.motion == 830) { go(cycle_.clear, 0); }
            go(depth + kPeckClearance_mm, 0);
            depth -= cycle_.peck;
        }
    }

    /// G86: the spindle stands still during the retract.
    void stop_for_retract() {
        context_.emit(Dwell{cycle_.dwell});
        context_.event(EventKind::SpindleStop);
        go(cycle_.retract, 0);
        context_.event(context_.state.modal.spindle == SpindleDirection::Forward ? EventKind::SpindleForward
                                                                                 : EventKind::SpindleReverse);
    }

    Context& context_;
    const Cycle& cycle_;
};

}  // namespace

Result canned_cycle(Context& context) {
    Cycle cycle{.axes = axes_of(context.state.modal.plane)};
    if (auto checked = check_cycle(context, cycle.axes); !checked) { return checked; }
    if (auto read = read_words(context, cycle); !read) { return read; }
    if (auto set = set_heights(context, cycle); !set) { return set; }
    if (context.motion == 860 && context.state.modal.spindle == SpindleDirection::Stopped) {
        return context.refuse_motion(" stops the spindle, but the spindle does not turn; write M3 or M4 before it");
    }
    CycleRun(context, cycle).run();
    return {};
}

}  // namespace lockstep::gcode
