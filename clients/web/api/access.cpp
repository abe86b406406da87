#include "clients/web/api/access.hpp"

#include <fmt/format.h>
#include <openssl/crypto.h>
#include <openssl/sha.h>

#include <algorithm>
#include <array>

#include "core/parse_number.hpp"

namespace lockstep::web {
namespace {

std::string hash_of(const std::string& text) {
    std::array<unsigned char, SHA256_DIGEST_LENGTH> digest{};
    (void)SHA256(reinterpret_cast<const unsigned char*>(text.data()), text.size(), digest.data());
    return fmt::format("{:02x}", fmt::join(digest, ""));
}

/// Takes a time that does not depend on where they differ.
bool equals(std::string_view a, std::string_view b) {
    return a.size() == b.size() && CRYPTO_memcmp(a.data(), b.data(), a.size()) == 0;
}

std::optional<Role> role_among(const Tokens& tokens, std::string_view given) {
    if (equals(given, tokens.operate)) { return Role::Operate; }
    if (equals(given, tokens.view)) { return Role::View; }
    return std::nullopt;
}

/// Returns the host in lower case without the port, an IPv6 address without its brackets. Empty if the text has
/// anything else. The port may be any, because a tunnel has its own.
std::string host_of(std::string_view text) {
    const bool is_six = text.starts_with('[');
    const std::size_t end = is_six ? text.find(']') : text.find(':');
    if (is_six && end == std::string_view::npos) { return ""; }
    const std::string_view rest = end == std::string_view::npos ? "" : text.substr(is_six ? end + 1 : end);
    if (!rest.empty() && (rest.front() != ':' || parse_number<std::uint16_t>(rest.substr(1)).value_or(0) == 0)) {
        return "";
    }
    return lower_case(is_six ? text.substr(1, end - 1) : text.substr(0, end));
}

bool has_proof(const Request& request, const std::string& cookie_name) {
    return request.header("authorization") != nullptr || request.cookie(cookie_name);
}

Problem without_session() {
    return {.status = 401,
            .code = "no-session",
            .title = "the request is not signed in",
            .detail = "the request has no valid session and no valid token",
            .place = "authorization",
            .limit = "Authorization: Bearer TOKEN, or the cookie of POST /api/session",
            .remedy = "open the address that lockstep-web printed at its start"};
}

Problem too_many_wrong() {
    return {.status = 429,
            .code = "too-many-tokens",
            .title = "too many wrong tokens",
            .detail = fmt::format("{} wrong tokens came from this address within a minute", WrongTokens::kMost),
            .limit = fmt::format("{} a minute", WrongTokens::kMost),
            .remedy =
                "wait a minute, then use the address that lockstep-web printed; hold, stop and estop with the "
                "right token are accepted at any time"};
}

Problem foreign(const std::string& header, const std::string& value, const std::string& limit) {
    return {.status = 403,
            .code = "foreign-" + header,
            .title = "the request comes from another site",
            .detail = header + " is '" + value.substr(0, 200) + "'",
            .place = header,
            .value = value.substr(0, 200),
            .limit = limit,
            .remedy = header == "host" ? "open the page by the address that lockstep-web printed; another name of this "
                                         "host is allowed by --host-name NAME"
                                       : "send requests from the page itself, or without an Origin header"};
}

}  // namespace

std::string_view name_of(Role role) { return role == Role::Operate ? "operate" : "view"; }

Access::Access(AccessRules rules)
    : rules_(std::move(rules)),
      cookie_name_(fmt::format("lockstep_session_{}", rules_.port)),
      cookies_{hash_of("cookie " + rules_.tokens.view), hash_of("cookie " + rules_.tokens.operate)} {
    std::ranges::transform(rules_.hosts, rules_.hosts.begin(), &lower_case);
}

std::optional<Problem> Access::refuse_foreign(const Request& request) const {
    const std::string* host = request.header("host");
    const std::string given = host == nullptr ? "" : *host;
    const std::string name = host_of(given);
    if (name.empty() || std::ranges::find(rules_.hosts, name) == rules_.hosts.end()) {
        return foreign("host", given, fmt::format("{}", fmt::join(rules_.hosts, ", ")));
    }
    const std::string* origin = request.header("origin");
    const std::string own = (rules_.is_tls ? "https://" : "http://") + given;
    if (origin != nullptr && *origin != own) { return foreign("origin", *origin, own); }
    return std::nullopt;
}

std::optional<Role> Access::proven(const Request& request) const {
    constexpr std::string_view kScheme = "Bearer ";
    const std::string* authorization = request.header("authorization");
    if (authorization != nullptr) {
        const bool is_bearer = authorization->starts_with(kScheme);
        return is_bearer ? role_among(rules_.tokens, authorization->substr(kScheme.size())) : std::nullopt;
    }
    const auto cookie = request.cookie(cookie_name_);
    return cookie ? role_among(cookies_, *cookie) : std::nullopt;
}

std::optional<Role> Access::role_of(const Request& request, std::chrono::nanoseconds now) const {
    const bool is_token = request.header("authorization") != nullptr;
    return is_token && wrong_.is_locked(request.peer, now) ? std::nullopt : proven(request);
}

std::expected<Role, Problem> Access::admit(const Request& request, bool is_stop, std::chrono::nanoseconds now) {
    const auto role = is_stop ? proven(request) : role_of(request, now);
    if (role) { return *role; }
    if (has_proof(request, cookie_name_)) {
        if (wrong_.is_locked(request.peer, now)) { return std::unexpected(too_many_wrong()); }
        wrong_.note(request.peer, now);
    }
    return std::unexpected(without_session());
}

std::expected<Role, Problem> Access::try_token(std::string_view token, const std::string& peer,
                                               std::chrono::nanoseconds now) {
    if (wrong_.is_locked(peer, now)) { return std::unexpected(too_many_wrong()); }
    const auto role = role_among(rules_.tokens, token);
    if (role) { return *role; }
    wrong_.note(peer, now);
    return std::unexpected(
        Problem{.status = 401,
                .code = "wrong-token",
                .title = "the token is wrong",
                .detail = "the token does not belong to this server",
                .place = "/token",
                .remedy = "use the address that lockstep-web printed at its start, or the token in its file"});
}

std::string Access::attributes() const {
    return std::string("; Path=/api; HttpOnly; SameSite=Strict") + (rules_.is_tls ? "; Secure" : "");
}

std::string Access::cookie_for(Role role) const {
    return cookie_name_ + "=" + (role == Role::Operate ? cookies_.operate : cookies_.view) + attributes();
}

std::string Access::removed_cookie() const { return cookie_name_ + "=; Max-Age=0" + attributes(); }

}  // namespace lockstep::web
