#include "clients/web/machine/jog_guard.hpp"

#include <fmt/format.h>

#include <algorithm>

#include "clients/web/state/limits.hpp"

namespace lockstep::web {
namespace {

Problem press_is_over(std::uint64_t press) {
    return {.status = 409,
            .code = "jog-over",
            .title = "the jog has ended",
            .detail = fmt::format("press {} was released, or was not renewed in time", press),
            .place = "/press",
            .value = press,
            .limit = fmt::format("a renewal every {} ms, and at the latest after {} ms", kJogRenew.count(),
                                 kJogLife.count()),
            .remedy = "release the key and press it again"};
}

}  // namespace

bool JogGuard::is_over(const JogOrder& order) const {
    const auto found = over_.find(order.stream);
    return order.press && found != over_.end() && *order.press <= found->second;
}

void JogGuard::note_over() {
    if (!press_) { return; }
    const bool is_new = !over_.contains(client_);
    over_[client_] = std::max(over_[client_], *press_);
    if (!is_new) { return; }
    order_.push_back(client_);
    if (order_.size() <= kMostClients) { return; }
    over_.erase(order_.front());
    order_.pop_front();
}

std::expected<JogGuard::Press, Problem> JogGuard::take(const JogOrder& order, Time now) {
    const bool is_other = until_ && client_ != order.stream;
    if (order.jogs.empty()) {  // another client's release changes nothing
        if (!is_other) {
            client_ = order.stream;
            press_ = order.press ? order.press : press_;
            end();
        }
        return Press::Released;
    }
    if (is_over(order)) { return std::unexpected(press_is_over(*order.press)); }
    if (is_other) { return std::unexpected(refused(FaultCode::Busy, "another client jogs the machine")); }
    const Press press = until_ && press_ == order.press ? Press::Renewed : Press::New;
    if (is_step_ && press == Press::New) {
        return std::unexpected(refused(FaultCode::Busy, "the step before is in progress; repeat this one later"));
    }
    if (press == Press::New) { is_step_ = order.is_step; }
    client_ = order.stream;
    press_ = order.press;
    until_ = now + kJogLife;
    return press;
}

bool JogGuard::runs_out(Time now) {
    if (!until_ || is_step_ || now < *until_) { return false; }
    end();
    return true;
}

void JogGuard::complete(Time now) {
    is_step_ = false;
    until_ = now + kJogLife;
}

bool JogGuard::end_stream(const std::string& stream) {
    if (!until_ || stream.empty() || client_ != stream || is_step_) { return false; }
    end();
    return true;
}

void JogGuard::end() {
    note_over();
    until_.reset();
    press_.reset();
    is_step_ = false;
}

}  // namespace lockstep::web
