// Who comes to the network and does not prove who he is, by what DDS traces of its discovery. Pure.
//
// DDS itself says so only where it was the one to be asked for proof; of one without a certificate it says nothing.
#pragma once

#include <chrono>
#include <map>
#include <optional>
#include <string>
#include <string_view>
#include <vector>

namespace lockstep {

class Newcomers {
public:
    /// A line of DDS's discovery trace. What is to be said of it at once: somebody came who has no certificate.
    std::optional<std::string> hear(std::chrono::nanoseconds now, std::string_view line);

    /// Each once: who has come with a certificate, stayed, and not proved within kPatience that it holds.
    std::vector<std::string> unproved(std::chrono::nanoseconds now);

private:
    static constexpr std::chrono::seconds kPatience{2};  // many times what the handshake takes
    static constexpr std::size_t kMaxPending = 256;  // then who comes is not watched; DDS shuts him out all the same

    struct Newcomer {
        std::chrono::nanoseconds came;
        std::string address;
    };
    std::map<std::string, Newcomer, std::less<>> pending_;
};

}  // namespace lockstep
