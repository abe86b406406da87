// Counts the wrong tokens of each address, and locks an address that has sent too many. Pure: the caller passes the
// time.
#pragma once

#include <chrono>
#include <cstddef>
#include <deque>
#include <map>
#include <string>

namespace lockstep::web {

class WrongTokens {
public:
    static constexpr std::size_t kMost = 10;  // of one address, within kWithin
    static constexpr std::chrono::seconds kWithin{60};
    static constexpr std::size_t kMostAddresses = 1000;  // that are remembered; the one that was silent longest goes

    bool is_locked(const std::string& address, std::chrono::nanoseconds now) const;
    void note(const std::string& address, std::chrono::nanoseconds now);

private:
    void forget_one();

    std::map<std::string, std::deque<std::chrono::nanoseconds>> times_;  // the last kMost of each address
};

}  // namespace lockstep::web
