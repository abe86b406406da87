#include "core/gcode/program_builder.hpp"

#include <algorithm>
#include <cmath>

#include "core/arc_path.hpp"
#include "core/axis_unit.hpp"
#include "core/gcode/curves/chords.hpp"
#include "core/gcode/curves/spline_arcs.hpp"
#include "core/number_text.hpp"

namespace lockstep::gcode {
namespace {

constexpr double kSecondsPerMinute = 60;
constexpr double kLeastArc_mm = 1e-5;
constexpr int kExactPathWord = 610;  // values of Modal::path_mode
constexpr int kExactStopWord = 611;

constexpr std::size_t kX = 0;  // in kAxisLetters
constexpr std::size_t kY = 1;
constexpr std::size_t kZ = 2;

/// How much higher Z is at this place because of the height map.
double height_at(const GcodeSetup& setup, const Point& place) {
    const auto& heights = setup.switches.heights;
    return heights ? heights->height_mm(place[kX], place[kY]) : 0;
}

/// Why a move with a feed cannot follow the height map: its depth beside the map is not known. Empty if it can.
std::string why_not_bent(const GcodeSetup& setup, const Point& from, const Point& to) {
    const auto& heights = setup.switches.heights;
    if (!heights) { return {}; }
    for (const char letter : {'X', 'Y', 'Z'}) {
        if (axis_letters(setup).find(letter) != std::string::npos) { continue; }
        return std::string("a height map needs axes X, Y and Z, but the machine has no axis ") + letter;
    }
    const bool moves_beside = from[kX] != to[kX] || from[kY] != to[kY];
    if (!moves_beside || (heights->has(from[kX], from[kY]) && heights->has(to[kX], to[kY]))) { return {}; }
    return "this move leaves the height map, which has " + heights->extent_text() +
           " (machine coordinates); measure a greater surface, or move the work";
}

Point place_in(const GcodeSetup& setup, double GcodeAxis::*coordinate) {
    Point place{};
    const auto places = axis_places(setup);
    for (std::size_t i = 0; i < places.size(); ++i) {
        if (places[i]) { place[*places[i]] = setup.axes[i].*coordinate; }
    }
    return place;
}

/// An arc is at least as long as the distance of its ends.
bool is_short(const ArcShape& shape, const std::vector<double>& from, const std::vector<double>& to) {
    const auto is_far = [&](std::size_t axis) { return std::abs(to[axis] - from[axis]) > 2 * kLeastArc_mm; };
    if (is_far(shape.first) || is_far(shape.second)) { return false; }
    return ArcPath(shape, from, to).plane_length_mm() < kLeastArc_mm;
}

bool moves_rotary(const GcodeSetup& setup, const std::vector<double>& from, const std::vector<double>& to) {
    for (std::size_t i = 0; i < to.size(); ++i) {
        if (to[i] != from[i] && is_rotary(setup.axes[i].name)) { return true; }
    }
    return false;
}

}  // namespace

std::vector<std::optional<std::size_t>> axis_places(const GcodeSetup& setup) {
    std::vector<std::optional<std::size_t>> places;
    places.reserve(setup.axes.size());
    for (const GcodeAxis& axis : setup.axes) { places.push_back(axis_place(axis.name)); }
    return places;
}

std::string axis_letters(const GcodeSetup& setup) {
    std::string letters;
    for (const auto& place : axis_places(setup)) {
        if (place) { letters += kAxisLetters[*place]; }
    }
    return letters;
}

Setup interpreter_setup(const GcodeSetup& setup, std::string_view text) {
    return {.axes = axis_letters(setup),
            .skip_deletable = setup.switches.skip_deletable,
            .awaits_touches = setup.awaits_touches,
            .limits = setup.limits,
            .program = text,
            .find_subroutine = setup.find_subroutine};
}

/// With a height map the program's places are those of a level surface.
State start_state(const GcodeSetup& setup) {
    State state;
    state.machine = place_in(setup, &GcodeAxis::start_mm);
    state.machine[kZ] -= height_at(setup, state.machine);
    set_kept_values(state, setup.values, park_place(setup));
    return state;
}

Point park_place(const GcodeSetup& setup) { return place_in(setup, &GcodeAxis::park_mm); }

std::optional<GcodeError> slow_feed(const Interpreter& interpreter) {
    const LineWords& block = interpreter.block();
    if (!block.has('F') || block['F'] <= 0 || block['F'] >= kMinFeedPerMinute) { return std::nullopt; }
    if (interpreter.state().modal.feed_mode != FeedMode::PerMinute) { return std::nullopt; }
    const Line& line = interpreter.line();
    const std::string why = " is too slow; F is per minute and must be at least " + number_text(kMinFeedPerMinute);
    if (line.number() != block.line) {  // the last line of a body that has ended
        return GcodeError{block.line, 1, "F" + number_text(block['F']) + why};
    }
    return line.error(block.place('F'), word_text(line, block.place('F')) + why);
}

ModalState modal_of(const State& now, const GcodeSetup& setup) {
    ModalState state{.inches = now.modal.inches, .relative = now.modal.relative, .feed_mm_min = {}, .offset_mm = {}};
    if (now.modal.feed_linear > 0) { state.feed_mm_min = now.modal.feed_linear; }
    const Point zero = to_machine(now.offsets, {});
    for (const auto& place : axis_places(setup)) { state.offset_mm.push_back(place ? zero[*place] : 0); }
    return state;
}

ProgramBuilder::ProgramBuilder(const GcodeSetup& setup) : setup_(setup), places_(axis_places(setup)) {
    program_.name = setup.program_name;
    for (const GcodeAxis& axis : setup.axes) {
        program_.axes.push_back(axis.name);
        program_.start_mm.push_back(axis.start_mm);
    }
    position_ = program_.start_mm;
    at_ = start_state(setup).machine;
}

void ProgramBuilder::take(const Action& action, int line, const Interpreter& interpreter) {
    if (line != line_) { outside_.clear(); }
    line_ = line;
    interpreter_ = &interpreter;
    if (const auto* straight = std::get_if<Straight>(&action)) {
        move(straight->target, straight->feed, straight->rapid);
    } else if (const auto* arc = std::get_if<Arc>(&action)) {
        this->arc(*arc);
    } else if (const auto* spline = std::get_if<Spline>(&action)) {
        this->spline(*spline);
    } else if (const auto* dwell = std::get_if<Dwell>(&action)) {
        append(*dwell);
    } else if (const auto* probing = std::get_if<Probing>(&action)) {
        probe(*probing);
    } else if (const auto* happens = std::get_if<Event>(&action)) {
        event(*happens);
    }
}

/// Reports each axis once per line, because many chords of a curve may be outside.
void ProgramBuilder::fail(std::size_t axis, const std::string& message) {
    if (!outside_.insert(axis).second) { return; }
    const Line& line = interpreter_->line();
    const char letter = kAxisLetters[*places_[axis]];
    if (line.number() != line_ || !interpreter_->block().has(letter)) { return fail("this takes " + message); }
    const std::size_t place = interpreter_->block().place(letter);
    errors_.push_back(line.error(place, word_text(line, place) + " takes " + message));
}

/// The motion may be of an earlier line, because cutter compensation emits it after a later line was read.
void ProgramBuilder::fail(const std::string& message) {
    const Line& line = interpreter_->line();
    errors_.push_back(line.number() == line_ ? line.error(0, message) : GcodeError{line_, 1, message});
}

/// Reports a place outside the travel, but returns it unchanged, so that later lines are checked as written.
double ProgramBuilder::within_travel(std::size_t i, double mm) {
    const GcodeAxis& axis = setup_.axes[i];
    const double nearest = std::clamp(mm, axis.min_mm, axis.max_mm);
    if (std::abs(mm - nearest) <= travel_tolerance_mm_) { return nearest; }
    const std::string unit(unit_of(axis.name));
    fail(i, axis.name + " to " + number_text(mm) + " " + unit + ", which is outside its travel of " +
                number_text(axis.min_mm) + " to " + number_text(axis.max_mm) + " " + unit +
                " (machine coordinates); change the program, or the axis's " +
                (mm < nearest ? "position_min_mm" : "position_max_mm"));
    return mm;
}

/// The shape of an arc in the plane of two of the setup's axes. Returns nullopt if the arc must be cut into chords.
std::optional<ArcShape> ProgramBuilder::shape_of(const Arc& arc) const {
    if (setup_.curves_as_chords || setup_.switches.heights) { return std::nullopt; }
    const auto normal = static_cast<std::size_t>(std::ranges::find(arc.axis, 1.0) - arc.axis.begin());
    if (normal >= arc.axis.size()) { return std::nullopt; }
    const std::size_t first = (normal + 1) % 3;
    const std::size_t second = (normal + 2) % 3;
    const auto place_of = [this](std::size_t letter) {
        return static_cast<std::size_t>(std::ranges::find(places_, std::optional(letter)) - places_.begin());
    };
    const ArcShape shape{.first = place_of(first),
                         .second = place_of(second),
                         .centre_first_mm = arc.centre[first],
                         .centre_second_mm = arc.centre[second],
                         .is_clockwise = arc.turns < 0,
                         .turns = std::abs(arc.turns)};
    const bool has_axes = shape.first < places_.size() && shape.second < places_.size();
    const bool is_near =
        std::abs(shape.centre_first_mm) <= kMaxCentre_mm / 2 && std::abs(shape.centre_second_mm) <= kMaxCentre_mm / 2;
    return has_axes && is_near ? std::optional(shape) : std::nullopt;
}

void ProgramBuilder::spline(const Spline& spline) {
    const Point from = at_;
    if (setup_.curves_as_chords || setup_.switches.heights) {
        return cut(spline, from, setup_.chord_tolerance_mm,
                   [&](const Point& target) { move(target, spline.feed, false); });
    }
    const double tolerance_mm = spline_tolerance_mm(setup_.chord_tolerance_mm);
    travel_tolerance_mm_ = std::max(tolerance_mm, kTravelTolerance_mm);
    cut_into_arcs(spline, from, tolerance_mm, [&](const Action& part) { take(part, line_, *interpreter_); });
    travel_tolerance_mm_ = kTravelTolerance_mm;
}

/// An arc of more chords than a program may have blocks is refused before it is cut.
void ProgramBuilder::arc_as_chords(const Arc& arc) {
    const Point from = at_;
    const double chords = chords_in(arc, from, setup_.chord_tolerance_mm);
    if (chords > static_cast<double>(kMaxProgramBlocks)) {
        at_ = arc.target;
        return fail("the arc takes " + number_text(chords) + " chords, but a program has at most " +
                    std::to_string(kMaxProgramBlocks) + " blocks; write fewer turns");
    }
    cut(arc, from, setup_.chord_tolerance_mm, [&](const Point& target) { move(target, arc.feed, false); });
}

void ProgramBuilder::arc(const Arc& arc) {
    const auto shape = shape_of(arc);
    if (!shape) { return arc_as_chords(arc); }
    std::vector<double>& to = next_position_;
    to = position_;
    for (std::size_t i = 0; i < to.size(); ++i) {
        if (!places_[i] || arc.target[*places_[i]] == at_[*places_[i]]) { continue; }
        to[i] = within_travel(i, arc.target[*places_[i]]);
    }
    const ArcRadii radii(*shape, position_, to);
    if (is_short(*shape, position_, to)) { return move(arc.target, arc.feed, false); }
    if (const std::string why = why_no_arc(radii.begin, radii.end); !why.empty()) { return fail("the arc " + why); }
    for (const auto& [i, centre] :
         {std::pair(shape->first, shape->centre_first_mm), std::pair(shape->second, shape->centre_second_mm)}) {
        const GcodeAxis& axis = setup_.axes[i];
        if (centre - radii.greatest() >= axis.min_mm && centre + radii.greatest() <= axis.max_mm) { continue; }
        const auto [least, greatest] = ArcPath(*shape, position_, to).extent(i);
        within_travel(i, least);
        within_travel(i, greatest);
    }
    append(move_to(to, arc.feed, shape));
    at_ = arc.target;
    position_.swap(to);
}

void ProgramBuilder::move(const Point& target, double feed, bool rapid) {
    const auto& heights = setup_.switches.heights;
    if (const std::string why = rapid ? "" : why_not_bent(setup_, at_, target); !why.empty()) {
        at_ = target;
        if (outside_.insert(places_.size()).second) { fail(why); }
        return;
    }
    const auto straight = [&](const Point& end) {
        std::vector<double>& to = next_position_;
        to = position_;
        const double height = height_at(setup_, end);
        const bool is_lifted = height != height_at(setup_, at_);
        for (std::size_t i = 0; i < to.size(); ++i) {
            if (!places_[i]) { continue; }
            const std::size_t letter = *places_[i];
            if (end[letter] == at_[letter] && !(letter == kZ && is_lifted)) { continue; }
            to[i] = within_travel(i, end[letter] + (letter == kZ ? height : 0));
        }
        at_ = end;
        if (to == position_) { return; }
        ProgramMove move = move_to(to, feed, {});
        if (rapid) { move.feed_mm_s = 0; }
        move.rapid = rapid;
        append(std::move(move));
        position_.swap(to);
    };
    heights ? heights->cut(Point(at_), target, setup_.chord_tolerance_mm, straight) : straight(target);
}

/// Makes a move with the present modes. `feed` is per minute.
ProgramMove ProgramBuilder::move_to(const std::vector<double>& to, double feed, std::optional<ArcShape> arc) const {
    const Modal& modal = interpreter_->state().modal;
    ProgramMove move{.target_mm = to, .feed_mm_s = feed / kSecondsPerMinute, .arc = arc};
    move.feed_mm_s = feed_along_path(move);
    move.is_feed_fixed = !modal.feed_override;
    switch (modal.path_mode) {
        case kExactPathWord: move.mode = PathMode::ExactPath; break;
        case kExactStopWord: move.mode = PathMode::ExactStop; break;
        default: move.tolerance_mm = std::min(modal.path_tolerance, kMaxTolerance_mm);
    }
    return move;
}

/// The feed of a ProgramMove is along the path of all axes. Returns the one with which the linear axes move at F.
double ProgramBuilder::feed_along_path(const ProgramMove& move) const {
    const std::vector<double>& target = move.target_mm;
    if (!moves_rotary(setup_, position_, target)) { return std::min(move.feed_mm_s, kMaxFeed_mm_s); }
    double linear = move.arc ? ArcPath(*move.arc, position_, target).plane_length_mm() : 0;
    double rotary = 0;
    for (std::size_t i = 0; i < target.size(); ++i) {
        if (target[i] == position_[i]) { continue; }
        if (move.arc && (i == move.arc->first || i == move.arc->second)) { continue; }
        double& length = is_rotary(setup_.axes[i].name) ? rotary : linear;
        length = std::hypot(length, target[i] - position_[i]);
    }
    const double share = linear <= kTravelTolerance_mm || rotary == 0 ? 1 : std::hypot(linear, rotary) / linear;
    return std::min(move.feed_mm_s * share, kMaxFeed_mm_s);
}

void ProgramBuilder::append(decltype(lockstep::Block::action) action) {
    await_speed(action);
    if (std::exchange(is_behind_probe_, false)) { append(Settle{}); }
    events_together_ = std::holds_alternative<ProgramEvent>(action) ? events_together_ + 1 : 0;
    if (events_together_ == kMaxEventsTogether + 1) {
        fail("the program has more than " + std::to_string(kMaxEventsTogether) +
             " words that move no axis, without a move between them; remove some");
    }
    if (blocks_.add({.line = line_, .action = std::move(action)})) { return; }
    is_full_ = true;
    errors_.push_back({line_, 1,
                       "the program has more than " + std::to_string(kMaxProgramBlocks) + " blocks; split it in two",
                       true});
}

}  // namespace lockstep::gcode
