#include "clients/web/api/api.hpp"

#include <fmt/format.h>

#include <algorithm>

#include "clients/web/request/body_reader.hpp"
#include "clients/web/request/head_check.hpp"
#include "clients/web/state/event_stream.hpp"
#include "clients/web/state/limits.hpp"
#include "clients/web/state/machine_document.hpp"
#include "clients/web/state/state_document.hpp"
#include "services/runtime/clock.hpp"

namespace lockstep::web {
namespace {

bool fits(std::string_view pattern, std::string_view path) {
    if (!pattern.ends_with('*')) { return path == pattern; }
    pattern.remove_suffix(1);
    return path.starts_with(pattern) && path.size() > pattern.size() && !path.substr(pattern.size()).contains('/');
}

Problem not_found(const std::string& path) {
    return {.status = 404,
            .code = "unknown-path",
            .title = "this path does not exist",
            .detail = "there is no path " + path.substr(0, 200),
            .place = "path",
            .value = path.substr(0, 200),
            .remedy = "see openapi.yaml"};
}

Problem wrong_method(const Request& request, const std::string& allowed) {
    return {.status = 405,
            .code = "wrong-method",
            .title = "the path does not accept this method",
            .detail = request.path.substr(0, 200) + " does not accept " + request.method.substr(0, 20),
            .place = "method",
            .value = request.method.substr(0, 20),
            .limit = allowed,
            .remedy = "see openapi.yaml"};
}

Problem only_views() {
    return {.status = 403,
            .code = "view-only",
            .title = "this token may only view",
            .detail = "the token's role is view, but this request needs operate",
            .place = "authorization",
            .value = "view",
            .limit = "operate",
            .remedy = "use the operate token from the file that lockstep-web named at its start"};
}

Problem too_long(std::size_t limit) {
    return {
        .status = 413,
        .code = "too-long",
        .title = "the body is too long",
        .detail = fmt::format("the body is longer than {} bytes", limit),
        .place = "body",
        .limit = fmt::format("{} bytes", limit),
        .remedy = limit == kMaxProgram_bytes ? "run a longer program with: lockstep run FILE" : "send a shorter body"};
}

Response refusal_of_access(const Problem& problem) {
    Response response = to_response(problem);
    if (problem.status == 401) { response.headers.emplace_back("WWW-Authenticate", "Bearer"); }
    return response;
}

/// A request that only makes the machine safer.
bool is_stop(std::string_view path) {
    return path == "/api/commands/hold" || path == "/api/commands/stop" || path == "/api/commands/estop";
}

bool is_changing(const Request& request) { return request.method != "GET" && request.method != "HEAD"; }

}  // namespace

const std::vector<Api::Row>& Api::rows() {
    static const std::vector<Row> kRows{
        {"POST", "/api/session", true, &Api::open_session},
        {"GET", "/api/session", false, &Api::show_session},
        {"DELETE", "/api/session", false, &Api::close_session},
        {"GET", "/api/machine", false, &Api::show_machine},
        {"GET", "/api/state", false, &Api::show_state},
        {"GET", "/api/events", false, &Api::open_events},
        {"POST", "/api/commands/*", false, &Api::take_command},
        {"POST", "/api/program", false, &Api::load},
        {"GET", "/api/program", false, &Api::show_program},
        {"GET", "/api/program/path", false, &Api::show_path},
        {"GET", "/api/mdi", false, &Api::show_mdi},
        {"GET", "/api/heights", false, &Api::show_heights},
        {"GET", "/api/reports", false, &Api::list_reports},
        {"GET", "/api/reports/*", false, &Api::show_report},
    };
    return kRows;
}

Api::Api(const ApiParts& parts, AccessRules rules)
    : parts_(parts),
      access_(std::move(rules)),
      stream_names_(fmt::format("s{}-", monotonic_now().count() & 0xffffff)),
      mdi_(parts.machine),
      orders_(parts.machine, parts.port, parts.desk, mdi_) {}

Intake Api::intake(const Request& head) const {
    if (refuse_head(head) || access_.refuse_foreign(head)) { return {.is_refused = true}; }
    const auto role = access_.role_of(head, monotonic_now());
    const bool is_program = head.path == "/api/program" && head.method == "POST" && role == Role::Operate;
    return {.body_limit_bytes = is_program ? kMaxProgram_bytes : kMaxBody_bytes, .is_signed_in = role.has_value()};
}

/// Adds the headers of every response, which tell a browser what it may do with it.
void Api::handle(Request&& request, const Answer& answer) {
    const bool is_api = request.path.starts_with("/api/");
    serve(std::move(request), [answer, is_api](Response&& response) {
        response.headers.emplace_back("X-Content-Type-Options", "nosniff");
        response.headers.emplace_back("Referrer-Policy", "no-referrer");
        response.headers.emplace_back("Cross-Origin-Resource-Policy", "same-origin");
        const auto has = [&](std::string_view name) {
            return std::ranges::any_of(response.headers, [&](const auto& header) { return header.first == name; });
        };
        if (is_api && !has("Cache-Control")) { response.headers.emplace_back("Cache-Control", "no-store"); }
        if (!has("Content-Security-Policy")) {
            response.headers.emplace_back("Content-Security-Policy", "default-src 'none'; frame-ancestors 'none'");
        }
        answer(std::move(response));
    });
}

void Api::serve(Request&& request, const Answer& answer) {
    if (const auto unclear = refuse_head(request)) {
        Response response = to_response(*unclear);
        response.headers.emplace_back("Connection", "close");
        return answer(std::move(response));
    }
    if (const auto foreign = access_.refuse_foreign(request)) { return answer(to_response(*foreign)); }
    std::string allowed;
    const Row* row = nullptr;
    for (const Row& one : rows()) {
        if (!fits(one.path, request.path)) { continue; }
        allowed += (allowed.empty() ? "" : ", ") + std::string(one.method);
        if (one.method == request.method || (one.method == "GET" && request.method == "HEAD")) { row = &one; }
    }
    if (allowed.empty() && !is_changing(request)) {
        if (auto asset = asset_response(parts_.assets, request)) { return answer(*std::move(asset)); }
    }
    if (allowed.empty()) { return answer(to_response(not_found(request.path))); }
    if (row == nullptr) {
        Response response = to_response(wrong_method(request, allowed));
        response.headers.emplace_back("Allow", allowed);
        return answer(std::move(response));
    }
    if (!row->is_open) {
        const auto role = access_.admit(request, is_stop(request.path), monotonic_now());
        if (!role) { return answer(refusal_of_access(role.error())); }
        const bool is_session = row->path == "/api/session";
        if (is_changing(request) && !is_session && *role != Role::Operate) { return answer(to_response(only_views())); }
    }
    if (request.is_too_long) { return answer(to_response(too_long(intake(request).body_limit_bytes))); }
    (this->*row->route)(std::move(request), answer);
}

void Api::open_session(Request&& request, const Answer& answer) {
    if (const auto other = refuse_other_type(request)) { return answer(to_response(*other)); }
    const auto body = read_object(request.body);
    if (!body) { return answer(to_response(body.error())); }
    std::optional<Problem> problem;
    BodyReader reader(*body, "", problem);
    reader.require("token");
    const std::string token = reader.text("token", 200).value_or("");
    reader.finish();
    if (problem) { return answer(to_response(*problem)); }
    const auto role = access_.try_token(token, request.peer, monotonic_now());
    if (!role) { return answer(to_response(role.error())); }
    Response response = json_response({{"role", name_of(*role)}});
    response.headers.emplace_back("Set-Cookie", access_.cookie_for(*role));
    answer(std::move(response));
}

void Api::show_session(Request&& request, const Answer& answer) {
    answer(json_response({{"role", name_of(*access_.role_of(request, monotonic_now()))}}));
}

void Api::close_session(Request&&, const Answer& answer) {
    answer({.status = 204, .body = std::string_view{}, .headers = {{"Set-Cookie", access_.removed_cookie()}}});
}

void Api::show_machine(Request&&, const Answer& answer) {
    answer(json_response(machine_document(parts_.machine, parts_.version)));
}

nlohmann::json Api::state_of(const Snapshot& snapshot) const {
    const auto loaded = parts_.desk.loaded();
    return state_document(snapshot, parts_.machine, loaded ? loaded->facts.get() : nullptr, mdi_.modes(), viewers_);
}

void Api::show_state(Request&&, const Answer& answer) { answer(json_response(state_of(*parts_.port.snapshot()))); }

void Api::publish(const Snapshot& snapshot) {
    mdi_.see(snapshot);
    if (viewers_ > 0) { parts_.log.publish(state_of(snapshot)); }
}

void Api::open_events(Request&& request, const Answer& answer) {
    if (viewers_ >= kMaxViewers) {
        return answer(to_response({.status = 503,
                                   .code = "too-many-viewers",
                                   .title = "too many viewers",
                                   .detail = fmt::format("{} event streams are open", kMaxViewers),
                                   .limit = std::to_string(kMaxViewers),
                                   .remedy = "close another page"}));
    }
    const std::string name = stream_names_ + std::to_string(++last_stream_);
    note_begin(name);
    publish(*parts_.port.snapshot());
    const std::string* last = request.header("last-event-id");
    auto stream = std::make_shared<EventStream>(parts_.log, parts_.log.place_after(last == nullptr ? "" : *last), name,
                                                &monotonic_now, [this, name] {
                                                    note_end(name);
                                                    parts_.port.end_stream(name);
                                                });
    answer({.body = std::shared_ptr<ByteStream>(std::move(stream)),
            .headers = {{"Content-Type", "text/event-stream"}, {"X-Accel-Buffering", "no"}}});
}

void Api::note_begin(const std::string& stream) {
    const std::lock_guard lock(streams_mutex_);
    streams_.insert(stream);
    viewers_ = streams_.size();
}

void Api::note_end(const std::string& stream) {
    const std::lock_guard lock(streams_mutex_);
    streams_.erase(stream);
    viewers_ = streams_.size();
}

bool Api::is_open(const std::string& stream) {
    const std::lock_guard lock(streams_mutex_);
    return streams_.contains(stream);
}

void Api::show_mdi(Request&&, const Answer& answer) {
    Json lines = Json::array();
    for (const auto& [line, accepted] : mdi_.lines()) { lines.push_back({{"line", line}, {"accepted", accepted}}); }
    answer(json_response({{"lines", lines}, {"modes", mdi_.modes().words}}));
}

}  // namespace lockstep::web
