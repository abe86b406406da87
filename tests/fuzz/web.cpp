// The input is a line with the name of a command of the web interface, then the command's body. The result is an order
// within the machine's bounds, or a refusal with a status and texts.
#include <algorithm>
#include <cmath>
#include <cstdint>
#include <string>

#include "clients/web/request/body_reader.hpp"
#include "clients/web/request/orders.hpp"
#include "tests/fuzz/require.hpp"
#include "tests/unit/session/two_axes.hpp"

namespace lockstep::web {
namespace {

constexpr std::size_t kLongestRefusal_bytes = 4096;

void check(const Problem& problem) {
    const bool is_known = problem.status == 400 || problem.status == 404 || problem.status == 422;
    require(is_known, "a refusal has a status of its own");
    require(!problem.code.empty() && !problem.title.empty() && !problem.detail.empty(), "a refusal has its texts");
    const std::string text = dumped(problem_json(problem));
    require(Json::accept(text), "a refusal is JSON");
    require(text.size() <= kLongestRefusal_bytes, "a refusal is short, however long the request is");
}

void check(const JogOrder& order, const MachineSetup& machine) {
    AxisSet seen;
    for (const JogAxis& jog : order.jogs) {
        require(jog.axis < machine.axes.size() && !seen.contains(jog.axis), "each of the machine's axes once");
        seen.insert(jog.axis);
        const double speed = std::abs(jog.speed_mm_s);
        require(speed > 0 && speed <= machine.axes[jog.axis].max_velocity_mm_s, "a velocity is within the axis's");
        const double distance_mm = jog.distance_mm.value_or(1);
        require(distance_mm > 0 && std::isfinite(distance_mm), "a distance is above 0 and finite");
    }
}

bool is_finite(const Letters& letters) {
    return std::ranges::all_of(letters, [](const auto& one) { return std::isfinite(one.second); });
}

void check(const Order& order, const MachineSetup& machine) {
    if (const auto* jog = std::get_if<JogOrder>(&order)) { check(*jog, machine); }
    if (const auto* mdi = std::get_if<MdiOrder>(&order)) {
        const bool is_line = !mdi->line.empty() && mdi->line.find_first_of("\n\r") == std::string::npos;
        require(is_line && mdi->line.size() <= kMaxLine_bytes, "mdi is one line");
    }
    if (const auto* touch = std::get_if<TouchOrder>(&order)) {
        require(touch->system < 9 && !touch->places.empty() && is_finite(touch->places), "a touch names places");
    }
    if (const auto* offset = std::get_if<OffsetOrder>(&order)) {
        require(offset->system < 9 && is_finite(offset->origin), "an offset names a system");
    }
    if (const auto* tool = std::get_if<ToolOrder>(&order)) {
        require(tool->number > 0 && is_finite(tool->offset), "a tool has a number");
    }
}

}  // namespace
}  // namespace lockstep::web

extern "C" int LLVMFuzzerTestOneInput(const std::uint8_t* data, std::size_t size) {
    using namespace lockstep;
    using namespace lockstep::web;
    static const MachineSetup machine = two_axes();
    const std::string_view text(reinterpret_cast<const char*>(data), size);
    const std::size_t end = text.find('\n');
    const std::string_view body = end == text.npos ? std::string_view{} : text.substr(end + 1);
    const auto order = read_order(text.substr(0, end), body, machine);
    if (!order) {
        check(order.error());
        return 0;
    }
    check(*order, machine);
    const std::string again = dumped(*read_object(body));
    require(read_order(text.substr(0, end), again, machine).has_value(), "what was accepted once is accepted again");
    return 0;
}
