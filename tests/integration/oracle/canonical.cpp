#include "tests/integration/oracle/canonical.hpp"

#include <algorithm>
#include <array>
#include <cmath>
#include <map>
#include <sstream>

namespace lockstep::oracle {
namespace {

constexpr double kFourDecimals = 0.51e-4;
constexpr double kSixDecimals = 1.01e-6;
constexpr double kOfFeeds = 0.001;
constexpr std::size_t kPlaces = 6;

using Place = std::array<double, kPlaces>;

std::vector<double> numbers_in(const std::string& text) {
    std::vector<double> numbers;
    const char* at = text.c_str();
    while (*at != '\0') {
        char* end = nullptr;
        const double value = std::strtod(at, &end);
        if (end == at) {
            ++at;
            continue;
        }
        numbers.push_back(value);
        at = end;
    }
    return numbers;
}

/// Reads rs274's calls. Keeps the offsets, units and feed that they set.
class OutputReader {
public:
    explicit OutputReader(bool is_exact) : is_exact_(is_exact) {}
    void take(const std::string& name, const std::string& arguments) {
        const std::vector<double> n = numbers_in(arguments);
        if (set(name, arguments, n) || move(name, n)) { return; }
        event(name, arguments, n);
    }
    std::vector<Call> calls;

private:
    double scale(std::size_t axis) const { return inches_ && axis < 3 ? 25.4 : 1; }

    bool set(const std::string& name, const std::string& arguments, const std::vector<double>& n) {
        if (name == "USE_LENGTH_UNITS") {
            inches_ = arguments.find("INCHES") != std::string::npos;
        } else if (name == "SET_G5X_OFFSET") {
            store(origin_, {n.begin() + 1, n.end()});
        } else if (name == "SET_G92_OFFSET") {
            store(g92_, n);
        } else if (name == "USE_TOOL_LENGTH_OFFSET") {
            store(tool_, n);
        } else if (name == "SET_XY_ROTATION") {
            rotation_ = n[0] / 57.295779513082320876798;
        } else if (name == "SET_FEED_RATE") {
            linear_feed_ = n[0] * scale(0);
            turning_feed_ = n[0];
        } else if (name == "SELECT_PLANE") {
            plane_ = arguments.find("XY") != std::string::npos ? 0 : arguments.find("XZ") != std::string::npos ? 1 : 2;
        } else {
            return false;
        }
        return true;
    }

    void store(Place& place, const std::vector<double>& n) {
        for (std::size_t i = 0; i < kPlaces && i < n.size(); ++i) { place[i] = n[i] * scale(i); }
    }

    void turn(double& x, double& y) const {
        const double turned = x * std::cos(rotation_) - y * std::sin(rotation_);
        y = x * std::sin(rotation_) + y * std::cos(rotation_);
        x = turned;
    }

    Place machine(Place p) const {
        for (std::size_t i = 0; i < kPlaces; ++i) { p[i] = p[i] * scale(i) + g92_[i]; }
        turn(p[0], p[1]);
        for (std::size_t i = 0; i < kPlaces; ++i) { p[i] += origin_[i] + tool_[i]; }
        return p;
    }

    /// The sum of some roundings, and the error of the place by a rounded angle.
    double tolerance(const Place& place) const {
        if (is_exact_) { return kSixDecimals; }
        const double reach = rotation_ == 0 ? 0 : 1e-6 * (std::abs(place[0]) + std::abs(place[1]));
        return 4 * kFourDecimals * (inches_ ? 25.4 : 1) + reach + (mixed_ ? 25.4 : 1) * kFourDecimals;
    }

    void add(const std::string& name, const Place& place, std::vector<double> more) {
        mixed_ = mixed_ || inches_;
        Call call{name, {place.begin(), place.end()}, tolerance(place), is_exact_ ? 0 : kOfFeeds};
        call.numbers.insert(call.numbers.end(), more.begin(), more.end());
        calls.push_back(std::move(call));
    }

    double feed_to(const Place& place) const {
        bool linear = false;
        const double least = tolerance(place);
        for (std::size_t i = 0; i < 3; ++i) { linear = linear || std::abs(place[i] - at_[i]) > least; }
        return linear ? linear_feed_ : turning_feed_;
    }

    bool move(const std::string& name, const std::vector<double>& n) {
        if (name == "STRAIGHT_TRAVERSE" || name == "STRAIGHT_FEED") {
            Place p{};
            std::copy_n(n.begin(), kPlaces, p.begin());
            p = machine(p);
            const bool rapid = name == "STRAIGHT_TRAVERSE";
            add(rapid ? "rapid" : "feed", p, {rapid ? 0 : feed_to(p)});
            arrive(p);
        } else if (name == "ARC_FEED") {
            arc(n);
        } else if (name == "NURBS_FEED") {
            calls.push_back({"spline", {n[0]}});
        } else {
            return false;
        }
        return true;
    }

    void arrive(const Place& p) { at_ = p; }

    void arc(const std::vector<double>& n) {
        const std::array<std::array<std::size_t, 3>, 3> axes{{{0, 1, 2}, {2, 0, 1}, {1, 2, 0}}};
        const auto [first, second, normal] = axes[plane_];
        Place end{};
        end[first] = n[0];
        end[second] = n[1];
        end[normal] = n[5];
        std::copy_n(n.begin() + 6, 3, end.begin() + 3);
        Place centre = end;
        centre[first] = n[2];
        centre[second] = n[3];
        end = machine(end);
        centre = machine(centre);
        const double turns = n[4];
        arrive(end);
        add("arc", end, {linear_feed_, turns});
        add_centre(centre, normal);
    }

    /// Without the coordinate normal to the arc's plane, which does not define the arc.
    void add_centre(const Place& centre, std::size_t normal) {
        Call call{"centre", {centre[0], centre[1], centre[2]}, tolerance(centre)};
        const bool is_turned = rotation_ != 0 && normal != 2;
        if (is_turned) { return; }
        call.numbers[normal] = 0;
        calls.push_back(std::move(call));
    }

    void event(const std::string& name, const std::string& arguments, const std::vector<double>& n) {
        if (name == "MESSAGE") {
            Call call{"message", numbers_in(arguments), kSixDecimals};
            calls.push_back(std::move(call));
            return;
        }
        if (name == "DWELL") { calls.push_back({"dwell", {n[0]}, kFourDecimals}); }
        static const std::map<std::string, std::string> kNamed{{"START_SPINDLE_CLOCKWISE", "forward"},
                                                               {"START_SPINDLE_COUNTERCLOCKWISE", "reverse"},
                                                               {"STOP_SPINDLE_TURNING", "stop spindle"},
                                                               {"MIST_ON", "mist"},
                                                               {"MIST_OFF", "mist off"},
                                                               {"FLOOD_ON", "flood"},
                                                               {"FLOOD_OFF", "flood off"},
                                                               {"PROGRAM_STOP", "stop"},
                                                               {"OPTIONAL_PROGRAM_STOP", "optional stop"}};
        static const std::map<std::string, std::string> kWithIndex{
            {"SELECT_TOOL", "select"},       {"CHANGE_TOOL", "change"},    {"CHANGE_TOOL_NUMBER", "number"},
            {"SET_MOTION_OUTPUT_BIT", "on"}, {"SET_AUX_OUTPUT_BIT", "on"}, {"CLEAR_MOTION_OUTPUT_BIT", "off"},
            {"CLEAR_AUX_OUTPUT_BIT", "off"}};
        static const std::map<std::string, Call> kSwitches{
            {"ENABLE_FEED_OVERRIDE", {"feed override", {1}}},   {"DISABLE_FEED_OVERRIDE", {"feed override", {0}}},
            {"ENABLE_SPEED_OVERRIDE", {"speed override", {1}}}, {"DISABLE_SPEED_OVERRIDE", {"speed override", {0}}},
            {"ENABLE_ADAPTIVE_FEED", {"adaptive feed", {1}}},   {"DISABLE_ADAPTIVE_FEED", {"adaptive feed", {0}}},
            {"ENABLE_FEED_HOLD", {"feed hold", {1}}},           {"DISABLE_FEED_HOLD", {"feed hold", {0}}}};
        if (const auto found = kSwitches.find(name); found != kSwitches.end()) { calls.push_back(found->second); }
        if (const auto found = kNamed.find(name); found != kNamed.end()) { calls.push_back({found->second, {}}); }
        if (const auto found = kWithIndex.find(name); found != kWithIndex.end()) {
            calls.push_back({found->second, {n[0]}});
        }
        if (name == "SET_SPINDLE_SPEED") { calls.push_back({"speed", {n[1]}, kFourDecimals}); }
        if (name == "SET_MOTION_OUTPUT_VALUE" || name == "SET_AUX_OUTPUT_VALUE") {
            calls.push_back({"analog", {n[0], n[1]}, kSixDecimals});
        }
    }

    bool is_exact_;
    Place origin_{};
    Place g92_{};
    Place tool_{};
    Place at_{};
    double rotation_ = 0;
    double linear_feed_ = 0;
    double turning_feed_ = 0;
    std::size_t plane_ = 0;
    bool inches_ = false;
    bool mixed_ = false;
};

/// The rounding of the output hides shorter moves, and so do offsets in inches.
constexpr double kRest = 0.004;
constexpr double kUnknown = 1e9;  // after a spline: the output does not give its end

bool is_at(const std::vector<double>& at, const Call& call) {
    for (std::size_t i = 0; i < kPlaces; ++i) {
        if (std::abs(call.numbers[i] - at[i]) > kRest) { return false; }
    }
    return true;
}

}  // namespace

std::string to_text(const Call& call) {
    std::ostringstream text;
    text.precision(9);
    text << call.name;
    for (const double number : call.numbers) { text << " " << number; }
    if (call.line > 0) { text << "  (line " << call.line << ")"; }
    return text.str();
}

bool equal(const Call& a, const Call& b) {
    if (a.name != b.name || a.numbers.size() != b.numbers.size()) { return false; }
    const double tolerance = std::max(a.tolerance, b.tolerance);
    for (std::size_t i = 0; i < a.numbers.size(); ++i) {
        const double relative = std::max(a.relative, b.relative) * std::abs(a.numbers[i]);
        if (std::abs(a.numbers[i] - b.numbers[i]) > tolerance * (1 + relative)) { return false; }
    }
    return true;
}

std::vector<Call> without_rests(const std::vector<Call>& calls) {
    std::vector<Call> kept;
    std::vector<double> at(kPlaces, 0.0);
    for (const Call& call : calls) {
        const bool moves = call.name == "rapid" || call.name == "feed";
        if (moves && is_at(at, call)) { continue; }
        kept.push_back(call);
        if (moves || call.name == "arc") { std::copy_n(call.numbers.begin(), kPlaces, at.begin()); }
        if (call.name == "spline") { at.assign(kPlaces, kUnknown); }
    }
    return kept;
}

namespace {

std::vector<Call> read_output(std::string_view output, bool is_exact) {
    OutputReader reader(is_exact);
    std::istringstream lines{std::string(output)};
    for (std::string line; std::getline(lines, line);) {
        const std::size_t open = line.find('(');
        const std::size_t close = line.rfind(')');
        if (open == std::string::npos || close == std::string::npos) { continue; }
        const std::size_t blank = line.rfind(' ', open);
        reader.take(line.substr(blank + 1, open - blank - 1), line.substr(open + 1, close - open - 1));
    }
    return reader.calls;
}

}  // namespace

std::vector<Call> calls_of_output(std::string_view output) { return read_output(output, false); }

std::vector<Call> calls_of_exact_output(std::string_view output) { return read_output(output, true); }

void CallList::add(std::string name, std::vector<double> numbers) {
    calls_.push_back({.name = std::move(name), .numbers = std::move(numbers), .line = line_});
}

void CallList::take(const gcode::Action& action, int line) {
    line_ = line;
    const auto numbers = [](const gcode::Point& target) {
        return std::vector<double>(target.begin(), target.begin() + kPlaces);
    };
    if (const auto* straight = std::get_if<gcode::Straight>(&action)) {
        std::vector<double> n = numbers(straight->target);
        n.push_back(straight->feed);
        add(straight->rapid ? "rapid" : "feed", n);
    } else if (const auto* arc = std::get_if<gcode::Arc>(&action)) {
        std::vector<double> n = numbers(arc->target);
        n.push_back(arc->feed);
        n.push_back(arc->turns);
        add("arc", n);
        std::vector<double> centre(arc->centre.begin(), arc->centre.end());
        const bool straight_axis = std::ranges::count(arc->axis, 0.0) == 2;
        for (std::size_t i = 0; i < 3; ++i) { centre[i] = std::abs(arc->axis[i]) > 0.5 ? 0 : centre[i]; }
        if (straight_axis) { add("centre", centre); }
    } else if (const auto* spline = std::get_if<gcode::Spline>(&action)) {
        add("spline", {static_cast<double>(spline->controls.size())});
    } else if (const auto* dwell = std::get_if<Dwell>(&action)) {
        add("dwell", {dwell->seconds});
    } else if (const auto* event = std::get_if<gcode::Event>(&action)) {
        take_event(*event);
    }
}

void CallList::take_event(const gcode::Event& event) {
    using gcode::EventKind;
    const double index = event.index;
    switch (event.kind) {
        case EventKind::Stop:
        case EventKind::PalletChange: return add("stop");
        case EventKind::OptionalStop: return add("optional stop");
        case EventKind::ToolSelect: return add("select", {index});
        case EventKind::ToolChange: return add("change", {index});
        case EventKind::ToolNumber: return add("number", {index});
        case EventKind::SpindleSpeed: return add("speed", {event.value});
        case EventKind::SpindleForward: return add("forward");
        case EventKind::SpindleReverse: return add("reverse");
        case EventKind::SpindleStop: return add("stop spindle");
        case EventKind::Mist: return add("mist");
        case EventKind::Flood: return add("flood");
        case EventKind::CoolantOff: add("mist off"); return add("flood off");
        case EventKind::FeedOverride: return add("feed override", {event.value});
        case EventKind::SpeedOverride: return add("speed override", {event.value});
        case EventKind::AdaptiveFeed: return add("adaptive feed", {event.value});
        case EventKind::FeedHold: return add("feed hold", {event.value});
        case EventKind::Output:
            if (event.switched == ProgramEvent::Kind::AnalogOutput) { return add("analog", {index, event.value}); }
            return add(event.switched == ProgramEvent::Kind::OutputOn ? "on" : "off", {index});
        case EventKind::Message: return add("message", numbers_in(event.text));
        default: return;
    }
}

}  // namespace lockstep::oracle
