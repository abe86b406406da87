// What DDS itself has to say: peers that it refuses, files that it cannot use. It says so on threads of its own, and of
// one stranger the same thing ten times a second.
#pragma once

#include <chrono>
#include <functional>
#include <map>
#include <optional>
#include <string>
#include <vector>

namespace lockstep {

/// Lets the first of each kind of message pass, and one of that kind in each period after; messages that differ in
/// identities alone are of one kind. Pure.
class RepeatFilter {
public:
    /// The message to say, with how many of its kind were held back; nothing: it is held back.
    std::optional<std::string> pass(std::chrono::nanoseconds now, const std::string& message);

private:
    static constexpr std::chrono::seconds kPeriod{10};
    static constexpr std::size_t kMaxKinds = 64;  // then all begins anew

    struct Kind {
        std::chrono::nanoseconds said;
        std::size_t held_back = 0;
    };
    std::map<std::string, Kind> kinds_;
};

/// From now on DDS's warnings and errors go there, filtered, on threads of DDS, one at a time; the process's only one.
void hear_dds(std::function<void(const std::string&)> say);

/// Says something there, as if DDS had.
void tell(const std::string& text);

/// What was said last; empty: nothing yet.
std::string dds_said_last();

/// From now on who comes without proof is told as well; the domain's profile must trace discovery. It replaces any
/// other trace of DDS.
void watch_newcomers();

/// Those who are to be told of by now (newcomers.hpp).
std::vector<std::string> unproved_newcomers(std::chrono::nanoseconds now);

/// This process takes part. Before that DDS refuses everybody whom it hears, which says nothing of them.
void note_joined();

}  // namespace lockstep
