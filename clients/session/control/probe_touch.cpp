#include "clients/session/control/probe_touch.hpp"

#include <cmath>
#include <utility>
#include <vector>

#include "clients/session/status_text.hpp"
#include "clients/text/format.hpp"
#include "core/gcode/session/probe_touch.hpp"
#include "services/runtime/clock.hpp"

namespace lockstep {
namespace {

using namespace std::chrono_literals;

constexpr std::chrono::nanoseconds kTouchPatience = 1s;

}  // namespace

std::optional<TouchOrError> received_touch(const Session& session, std::uint64_t job, std::chrono::nanoseconds since) {
    const MachineConfig& machine = session.config();
    const auto& result = session.state()->state.probe;
    if (!result || result->job != job) { return std::nullopt; }
    std::vector<double> rest_mm;
    for (const AxisIndex i : axis_indices(machine.axes.size())) {
        const auto& axis = session.received().axis(i);
        if (!axis || axis->time <= since || !axis->state.at_rest) { return std::nullopt; }
        rest_mm.push_back(to_mm(machine.axes[i], static_cast<double>(axis->state.position.count())));
    }
    auto touch = touch_from(*result, std::move(rest_mm));
    if (!touch) { return TouchOrError(std::unexpected(touch.error().text())); }
    return TouchOrError(*std::move(touch));
}

std::expected<ProbeTouch, Failure> touch_of(Session& session, std::uint64_t job) {
    const std::chrono::nanoseconds since = monotonic_now();
    std::optional<TouchOrError> touch;
    const auto is_known = [&] { return (touch = received_touch(session, job, since)).has_value(); };
    const bool is_received = session.receive_until(kTouchPatience, is_known);
    if (is_received && !*touch) { return std::unexpected(failed(touch->error())); }
    if (is_received) { return **std::move(touch); }
    return std::unexpected(failed("the result of the probing move of job " + std::to_string(job) +
                                  ", and where the axes rest, are not received; see: lockstep status"));
}

proto::ProbeReport probe_report(const MachineConfig& machine, const ProbeTouch& touch) {
    proto::ProbeReport report;
    report.set_touched(touch.touched);
    if (touch.input && *touch.input < machine.inputs.size()) { report.set_input(machine.inputs[*touch.input].name); }
    for (const AxisIndex i : axis_indices(machine.axes.size())) {
        proto::ProbePlace& place = *report.add_places();
        place.set_name(machine.axes[i].name);
        place.set_position_mm(touch.places_mm[i]);
        place.set_behind_mm(touch.rest_mm[i] - touch.places_mm[i]);
    }
    return report;
}

std::string text_of(const proto::ProbeReport& probe) {
    std::string places;
    double behind = 0;
    for (const proto::ProbePlace& place : probe.places()) {
        places += (places.empty() ? "" : "  ") + axis_label(place.name()) + " " + fixed(place.position_mm(), 4);
        behind = std::hypot(behind, place.behind_mm());
    }
    if (!probe.touched()) { return "did not touch; the move ended at " + places; }
    return "input " + probe.input() + " touched at " + places + "; the axes rest " + fixed(behind, 4) + " mm behind it";
}

}  // namespace lockstep
