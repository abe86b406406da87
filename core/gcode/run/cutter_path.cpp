// The path of the tool's centre: one motion of the program after the other, with the corners between them.
#include <algorithm>
#include <cmath>
#include <utility>

#include "core/gcode/run/compensation.hpp"
#include "core/gcode/run/corner.hpp"
#include "core/number_text.hpp"

namespace lockstep::gcode {
namespace {

constexpr double kLeastLength_mm = 1e-9;
constexpr double kSweepTolerance = 0.1;  // radians: corners too small to be rounded may lengthen an arc by this

void set_in_plane(PlaneAxes axes, Point& point, Flat place) {
    point[axes.first] = place.x;
    point[axes.second] = place.y;
}

class CutterPath {
public:
    explicit CutterPath(Context& context)
        : context_(context),
          state_(context.state),
          cutter_(state_.cutter),
          axes_(axes_of(state_.modal.plane)),
          radius_(state_.modal.side == Side::Left ? state_.modal.tool_radius : -state_.modal.tool_radius) {}

    Result straight(const Point& target, bool rapid) {
        const Flat from = in_plane(axes_, state_.program);
        const Flat to = in_plane(axes_, target);
        const double length = length_of(to - from);
        const double feed = rapid ? 0 : feed_of(context_, state_.program, target);
        CutMove move{.target = target, .from = cutter_.at, .feed = feed, .rapid = rapid};
        const Flat direction = (to - from) * (1 / length);
        const Flat aside = left_of(direction) * radius_;
        if (!cutter_.entered) {
            if (length <= std::abs(radius_)) { return refuse_entry(length); }
            enter(move);
            return go(move, to + aside);
        }
        if (length <= kLeastLength_mm) { return stay(move); }
        move.direction = direction;
        if (auto turned = turn(move, {from + aside, direction, {}}); !turned) { return turned; }
        return go(move, to + aside);
    }

    Result arc(const ArcMove& arc) {
        const Flat from = in_plane(axes_, state_.program);
        const Flat to = in_plane(axes_, arc.target);
        const double side = arc.turns > 0 ? 1 : -1;
        const double inward = side * radius_;  // from the programmed arc to the tool's centre, toward the arc's centre
        const double begins = length_of(from - arc.centre);
        const double ends = length_of(to - arc.centre);
        if (std::min(begins, ends) <= inward) { return refuse_arc(std::min(begins, ends)); }
        CutMove move{.target = arc.target, .from = cutter_.at, .centre = arc.centre, .turns = arc.turns};
        move.radius = ends - inward;
        move.sweep = sweep_of(from, arc.centre, to, side > 0, 1);
        move.feed = feed_of(context_, state_.program, arc.target, path_of(move, begins));
        const Flat end = arc.centre + (to - arc.centre) * ((ends - inward) / ends);
        if (!cutter_.entered) {
            if (auto entered = enter_arc(move, from, to, end); !entered) { return entered; }
            return go(move, end);
        }
        const Flat start = arc.centre + (from - arc.centre) * ((begins - inward) / begins);
        const Flat direction = left_of(from - arc.centre) * (side / begins);
        if (auto turned = turn(move, {start, direction, arc.centre, begins - inward}); !turned) { return turned; }
        return go(move, end);
    }

    void flush() {
        for (const Waiting& waiting : std::exchange(cutter_.waiting, {})) {
            if (const auto* move = std::get_if<CutMove>(&waiting.what)) {
                send(*move, waiting.line);
            } else {
                context_.sink(std::get<Action>(waiting.what), waiting.line);
            }
        }
    }

private:
    double path_of(const CutMove& arc, double radius) const {
        const double sweep = arc.sweep + 2 * std::numbers::pi * (std::abs(arc.turns) - 1);
        return std::hypot(sweep * radius, arc.target[axes_.normal] - state_.program[axes_.normal]);
    }

    std::unexpected<GcodeError> refuse_entry(double length) const {
        return context_.refuse_motion(" is the first motion of cutter compensation and goes " + number_text(length) +
                                      " mm in its plane; it must be longer than the tool's radius, " +
                                      number_text(std::abs(radius_)) + " mm");
    }

    std::unexpected<GcodeError> refuse_arc(double radius) const {
        return context_.refuse_motion(" has a radius of " + number_text(radius) +
                                      " mm on the tool's side; the tool's radius, " + number_text(std::abs(radius_)) +
                                      " mm, must be less");
    }

    std::unexpected<GcodeError> refuse_gouge() const {
        return context_.refuse_motion(" makes a corner that a tool of radius " + number_text(std::abs(radius_)) +
                                      " mm cannot reach without cutting into the path; use a thinner tool, or write "
                                      "longer motions");
    }

    void enter(CutMove& move) {
        if (!cutter_.stands) { cutter_.stands = Standing{state_.program, state_.machine}; }
        cutter_.at = move.from = in_plane(axes_, state_.program);
    }

    /// An arc from the present place that reaches the offset end in the programmed direction: its centre is on the line
    /// from that end to the programmed centre, as far from the start as from the end.
    Result enter_arc(CutMove& move, Flat from, Flat to, Flat end) {
        if (length_of(to - from) <= std::abs(radius_)) { return refuse_entry(length_of(to - from)); }
        const Flat inward = (*move.centre - end) * (1 / length_of(*move.centre - end));
        const Flat chord = from - end;
        const double along = dot(inward, chord);
        if (along <= kLeastLength_mm) { return refuse_gouge(); }
        if (cutter_.tip != Flat{}) {
            return context_.refuse_motion(" begins cutter compensation of a lathe tool; begin with a straight motion");
        }
        enter(move);
        move.centre = end + inward * (dot(chord, chord) / (2 * along));
        move.radius = length_of(end - *move.centre);
        move.sweep = sweep_of(from, *move.centre, end, move.turns > 0, 1);
        return {};
    }

    /// Ends the motion that waits for this corner, and emits it.
    Result turn(CutMove& move, const Track& next) {
        const Flat corner = in_plane(axes_, state_.program);
        const Track last = last_track(corner);
        switch (corner_between(last, next, corner, radius_)) {
            case CornerKind::Straight: flush(); break;
            case CornerKind::Outside:
                flush();
                go_round(move, corner, next.at);
                break;
            case CornerKind::Inside: {
                const auto place = meeting(last, next, corner);
                if (!place || !end_last_at(*place)) { return refuse_gouge(); }
                flush();
            }
        }
        move.from = cutter_.at;
        return {};
    }

    Track last_track(Flat corner) const {
        const Flat left = (cutter_.at - corner) * (1 / radius_);
        const auto& move = std::get<CutMove>(cutter_.waiting.front().what);
        return {cutter_.at, {left.y, -left.x}, move.centre, move.radius};
    }

    /// Returns false if the waiting motion would have to go backward.
    bool end_last_at(Flat place) {
        for (Waiting& waiting : cutter_.waiting) {
            if (auto* move = std::get_if<CutMove>(&waiting.what)) { set_in_plane(axes_, move->target, place); }
        }
        cutter_.at = place;
        return fits(std::get<CutMove>(cutter_.waiting.front().what));
    }

    bool fits(const CutMove& move) const {
        const Flat end = in_plane(axes_, move.target);
        if (!move.centre) { return dot(move.direction, end - move.from) >= -kLeastLength_mm; }
        return sweep_of(move.from, *move.centre, end, move.turns > 0, 1) <= move.sweep + kSweepTolerance;
    }

    /// Goes around an outside corner: along an arc, or straight if the next motion is rapid. As in LinuxCNC, the next
    /// motion's turning axes move here.
    void go_round(const CutMove& next, Flat corner, Flat to) {
        CutMove round{.target = state_.program, .from = cutter_.at, .feed = next.feed, .rapid = next.rapid};
        std::copy(next.target.begin() + 3, next.target.end(), round.target.begin() + 3);
        set_in_plane(axes_, round.target, to);
        if (!next.rapid) { round.centre = corner; }
        round.turns = radius_ > 0 ? -1 : 1;
        send(round, context_.line.number());
        cutter_.at = to;
    }

    Result go(CutMove& move, Flat end) {
        const Point target = move.target;
        set_in_plane(axes_, move.target, end);
        if (!fits(move)) { return refuse_gouge(); }
        cutter_.waiting.push_back({context_.line.number(), move});
        cutter_.entered = true;
        cutter_.at = end;
        return arrive(target);
    }

    /// A motion in which the plane's axes rest.
    Result stay(CutMove& move) {
        if (cutter_.waiting.size() >= kMostWaiting) {
            return context_.refuse_motion(" is one of more than " + std::to_string(kMostWaiting) +
                                          " blocks in sequence that do not move in the plane; write G40 before them");
        }
        const Point target = move.target;
        set_in_plane(axes_, move.target, cutter_.at);
        cutter_.waiting.push_back({context_.line.number(), move});
        return arrive(target);
    }

    Result arrive(const Point& target) {
        state_.machine = machine_target(state_, target);
        state_.program = target;
        return {};
    }

    void send(const CutMove& move, int line) {
        Point place = move.target;
        set_in_plane(axes_, place, in_plane(axes_, place) + cutter_.tip);
        const Point machine = machine_target(state_.offsets, *cutter_.stands, place);
        if (move.centre) {
            Point at = cutter_.stands->program;
            set_in_plane(axes_, at, *move.centre + cutter_.tip);
            at = to_machine(state_.offsets, at);
            context_.sink(Arc{.target = machine,
                              .centre = {at[0], at[1], at[2]},
                              .axis = turned_axis(state_, axes_.normal),
                              .turns = move.turns,
                              .feed = move.feed},
                          line);
        } else if (machine != cutter_.stands->machine) {
            context_.sink(Straight{machine, move.feed, move.rapid}, line);
        }
        cutter_.stands = Standing{place, machine};
    }

    Context& context_;
    State& state_;
    CutterState& cutter_;
    PlaneAxes axes_;
    double radius_;  // above 0: the tool's centre is on the left
};

/// After a refused motion the program is read without compensation. Nothing of it will run, but its other errors are
/// found.
Result end_if_refused(Context& context, Result result) {
    if (result) { return result; }
    context.state.cutter.waiting.clear();
    leave_compensation(context);
    return result;
}

}  // namespace

Result compensated_straight(Context& context, const Point& target, bool rapid) {
    return end_if_refused(context, CutterPath(context).straight(target, rapid));
}

Result compensated_arc(Context& context, const ArcMove& arc) {
    return end_if_refused(context, CutterPath(context).arc(arc));
}

Point shown_place(const State& state) {
    Point place = state.program;
    if (is_offset(state) && state.cutter.entered) { set_in_plane(axes_of(state.modal.plane), place, state.cutter.at); }
    return place;
}

void leave_compensation(Context& context) {
    CutterPath(context).flush();
    context.state.modal.side = Side::None;
    context.state.modal.tool_radius = 0;
    context.state.cutter.entered = false;
}

void end_compensation(Context& context) {
    State& state = context.state;
    leave_compensation(context);
    if (!state.cutter.stands) { return; }
    state.machine = std::exchange(state.cutter.stands, {})->machine;
    offsets_changed(context);
}

}  // namespace lockstep::gcode
