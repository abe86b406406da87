// Decides who may do what: by tokens, by the cookie that stands for a token, and by the host and origin that a request
// names. Pure, apart from the hash.
#pragma once

#include <chrono>
#include <cstdint>
#include <expected>
#include <optional>
#include <string>
#include <string_view>
#include <vector>

#include "clients/web/api/wrong_tokens.hpp"
#include "clients/web/http/message.hpp"
#include "clients/web/request/problem.hpp"

namespace lockstep::web {

enum class Role : std::uint8_t { View, Operate };
std::string_view name_of(Role role);

struct Tokens {
    std::string view;
    std::string operate;
};

struct AccessRules {
    Tokens tokens;
    std::vector<std::string> hosts;  // names and addresses that a Host header may have, without the port
    std::uint16_t port = 0;
    bool is_tls = false;
};

class Access {
public:
    explicit Access(AccessRules rules);

    /// Refuses (403) a request that another site's page sent, or that came under another host name.
    std::optional<Problem> refuse_foreign(const Request& request) const;
    /// The role by the request's cookie or Authorization header; nullopt if it has neither, or a wrong one, or a token
    /// while its address is locked.
    std::optional<Role> role_of(const Request& request, std::chrono::nanoseconds now) const;
    /// The same, and counts a wrong cookie or token. Fails with 401, or with 429 while the address is locked. The right
    /// token of a stop is accepted nevertheless, and so is the cookie of a page that is signed in.
    std::expected<Role, Problem> admit(const Request& request, bool is_stop, std::chrono::nanoseconds now);
    /// Exchanges a token for its role. Fails with 401 for a wrong token, with 429 while the address is locked.
    std::expected<Role, Problem> try_token(std::string_view token, const std::string& peer,
                                           std::chrono::nanoseconds now);

    /// The value of a Set-Cookie header.
    std::string cookie_for(Role role) const;
    std::string removed_cookie() const;

private:
    /// The role by the request's cookie or token, whether or not its address is locked.
    std::optional<Role> proven(const Request& request) const;
    std::string attributes() const;

    AccessRules rules_;
    std::string cookie_name_;  // has the port, because browsers share cookies among a host's ports
    Tokens cookies_;           // a hash of each token
    WrongTokens wrong_;
};

}  // namespace lockstep::web
