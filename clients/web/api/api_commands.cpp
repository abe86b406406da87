// The requests that give commands.
#include <fmt/format.h>

#include "clients/web/api/api.hpp"
#include "clients/web/request/body_reader.hpp"
#include "services/runtime/clock.hpp"

namespace lockstep::web {
namespace {

constexpr std::size_t kMaxKey_bytes = 64;

Problem replayed(const std::string& key) {
    return {.status = 409,
            .code = "replayed",
            .title = "this command was already sent",
            .detail =
                "a command with this Idempotency-Key arrived within the last ten minutes; it is not carried out again",
            .place = "idempotency-key",
            .value = key,
            .limit = "a new key for each command",
            .remedy = "read the state for the result of the first command"};
}

Problem closed_stream(const std::string& name) {
    return {.status = 409,
            .code = "stream-closed",
            .title = "the jog names no open event stream",
            .detail = "the event stream '" + name + "' is not open",
            .place = "/stream",
            .value = name,
            .limit = "the name that the first event of an open stream of GET /api/events gives",
            .remedy = "open an event stream and name it, or leave the name out"};
}

}  // namespace

void Api::take_command(Request&& request, const Answer& answer) {
    if (const auto other = refuse_other_type(request)) { return answer(to_response(*other)); }
    const std::string verb = request.path.substr(request.path.rfind('/') + 1);
    const auto order = read_order(verb, request.body, parts_.machine);
    if (!order) { return answer(to_response(order.error())); }
    const auto* jog = std::get_if<JogOrder>(&*order);
    if (jog != nullptr && !jog->jogs.empty() && !jog->stream.empty() && !is_open(jog->stream)) {
        return answer(to_response(closed_stream(jog->stream)));
    }
    if (const std::string* key = request.header("idempotency-key")) {
        if (key->empty() || key->size() > kMaxKey_bytes) {
            return answer(to_response(wrong_value(400, "idempotency-key", key->substr(0, 100), "1 to 64 characters")));
        }
        if (!replays_.use(*key, monotonic_now())) { return answer(to_response(replayed(*key))); }
    }
    orders_.carry_out(*order, [answer](Outcome&& outcome) {
        answer(outcome ? json_response(accepted_json(*outcome)) : to_response(outcome.error()));
    });
}

}  // namespace lockstep::web
