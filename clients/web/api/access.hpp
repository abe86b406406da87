// Decides who may do what: by tokens, by the cookie that stands for a token, and by the host and origin that a request
// names. Pure, apart from the hash.
#pragma once

#include <chrono>
#include <cstdint>
#include <deque>
#include <expected>
#include <optional>
#include <string>
#include <string_view>
#include <vector>

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
    static constexpr std::size_t kMostWrongTokens = 10;  // in kWrongTokensWithin, of all clients together
    static constexpr std::chrono::seconds kWrongTokensWithin{60};

    explicit Access(AccessRules rules);

    /// Refuses (403) a request that another site's page sent, or that came under another host name.
    std::optional<Problem> refuse_foreign(const Request& request) const;
    /// The role by the request's cookie or Authorization header; nullopt if it has neither, or a wrong one.
    std::optional<Role> role_of(const Request& request) const;
    /// Fails with 401 for a wrong token, with 429 after too many wrong ones.
    std::expected<Role, Problem> try_token(std::string_view token, std::chrono::nanoseconds now);

    /// The value of a Set-Cookie header.
    std::string cookie_for(Role role) const;
    std::string removed_cookie() const;

private:
    std::string attributes() const;

    AccessRules rules_;
    std::string cookie_name_;  // has the port, because browsers share cookies among a host's ports
    Tokens cookies_;           // a hash of each token
    std::deque<std::chrono::nanoseconds> wrong_;
};

}  // namespace lockstep::web
