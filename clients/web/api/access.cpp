#include "clients/web/api/access.hpp"

#include <fmt/format.h>
#include <openssl/crypto.h>
#include <openssl/sha.h>

#include <algorithm>
#include <array>

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

/// Returns the host without the port, an IPv6 address without its brackets.
std::string_view host_of(std::string_view text) {
    if (text.starts_with('[')) {
        const std::size_t end = text.find(']');
        return end == std::string_view::npos ? text : text.substr(1, end - 1);
    }
    return text.substr(0, text.find(':'));
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
      cookies_{hash_of("cookie " + rules_.tokens.view), hash_of("cookie " + rules_.tokens.operate)} {}

std::optional<Problem> Access::refuse_foreign(const Request& request) const {
    const std::string* host = request.header("host");
    const std::string given = host == nullptr ? "" : *host;
    if (std::ranges::find(rules_.hosts, host_of(given)) == rules_.hosts.end()) {
        return foreign("host", given, fmt::format("{}", fmt::join(rules_.hosts, ", ")));
    }
    const std::string* origin = request.header("origin");
    const std::string own = (rules_.is_tls ? "https://" : "http://") + given;
    if (origin != nullptr && *origin != own) { return foreign("origin", *origin, own); }
    return std::nullopt;
}

std::optional<Role> Access::role_of(const Request& request) const {
    constexpr std::string_view kScheme = "Bearer ";
    const std::string* authorization = request.header("authorization");
    if (authorization != nullptr) {
        const bool is_bearer = authorization->starts_with(kScheme);
        return is_bearer ? role_among(rules_.tokens, authorization->substr(kScheme.size())) : std::nullopt;
    }
    const auto cookie = request.cookie(cookie_name_);
    return cookie ? role_among(cookies_, *cookie) : std::nullopt;
}

std::expected<Role, Problem> Access::try_token(std::string_view token, std::chrono::nanoseconds now) {
    while (!wrong_.empty() && now - wrong_.front() > kWrongTokensWithin) { wrong_.pop_front(); }
    if (wrong_.size() >= kMostWrongTokens) {
        return std::unexpected(Problem{.status = 429,
                                       .code = "too-many-tokens",
                                       .title = "too many wrong tokens",
                                       .detail = fmt::format("{} wrong tokens arrived within a minute", wrong_.size()),
                                       .limit = fmt::format("{} a minute", kMostWrongTokens),
                                       .remedy = "wait a minute, then use the address that lockstep-web printed"});
    }
    const auto role = role_among(rules_.tokens, token);
    if (role) { return *role; }
    wrong_.push_back(now);
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
