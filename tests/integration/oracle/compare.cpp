#include "tests/integration/oracle/compare.hpp"

#include <algorithm>
#include <array>
#include <cmath>
#include <optional>
#include <utility>

#include "tests/integration/oracle/differences.hpp"

namespace lockstep::oracle {
namespace {

/// Only up to the end of the shorter list: a refused line may have acted before its error.
std::optional<std::size_t> first_difference(const std::vector<Call>& theirs, const std::vector<Call>& ours) {
    const std::size_t count = std::min(theirs.size(), ours.size());
    for (std::size_t i = 0; i < count; ++i) {
        if (!equal(theirs[i], ours[i])) { return i; }
    }
    return std::nullopt;
}

/// Splits the calls into messages and T, and all others.
std::pair<std::vector<Call>, std::vector<Call>> parted(const std::vector<Call>& calls) {
    std::pair<std::vector<Call>, std::vector<Call>> parts;
    for (const Call& call : calls) {
        (call.name == "message" || call.name == "select" ? parts.first : parts.second).push_back(call);
    }
    return parts;
}

}  // namespace

Difference difference_of_calls(const std::string& text, const std::vector<Call>& theirs,
                               const std::vector<Call>& ours) {
    const auto at = first_difference(theirs, ours);
    if (!at) { return {}; }
    return {"call " + std::to_string(*at) + "\n  rs274: " + to_text(theirs[*at]) + "\n  ours:  " + to_text(ours[*at]),
            may_move_apart(text, theirs, ours, *at)};
}

namespace {

/// With cutter compensation rs274 gives messages at once, and motions later.
Difference difference_of(const std::string& text, const Reading& theirs, const Reading& ours) {
    const bool compensates = text.find("G41") != std::string::npos || text.find("G42") != std::string::npos;
    if (!compensates) { return difference_of_calls(text, theirs.calls, ours.calls); }
    const auto [their_messages, their_calls] = parted(theirs.calls);
    const auto [our_messages, our_calls] = parted(ours.calls);
    const Difference difference = difference_of_calls(text, their_calls, our_calls);
    return difference.text.empty() ? difference_of_calls(text, their_messages, our_messages) : difference;
}

/// Whether the call is part of rs274's reset of the machine at M2.
bool is_of_the_end(const Call& call) {
    constexpr std::array kNames{"stop spindle", "mist off", "flood off", "feed override", "speed override"};
    return std::ranges::find(kNames, call.name) != kNames.end();
}

/// The first kept parameter that differs. rs274's file has six decimals, in inches.
std::string kept_difference(const Reading& theirs, const Reading& ours) {
    constexpr double kSixDecimals_mm = 2e-5;
    for (const auto& [number, value] : theirs.kept) {
        if (std::abs(value - ours.kept.at(number)) <= kSixDecimals_mm) { continue; }
        return "#" + std::to_string(number) + " at the end\n  rs274: " + std::to_string(value) +
               "\n  ours:  " + std::to_string(ours.kept.at(number));
    }
    return "";
}

std::string difference_at_end(const std::string& text, const Reading& theirs, const Reading& ours) {
    if (theirs.taken != ours.taken) {
        if (may_refuse_alone(text, theirs, ours)) { return ""; }
        return theirs.taken ? "refused by us alone, line " + std::to_string(ours.line) + ": " + ours.message + "\n  " +
                                  line_of(text, ours.line)
                            : "refused by rs274 alone: " + theirs.message + "\n  " + theirs.refused;
    }
    if (!theirs.taken) { return ""; }
    if (theirs.calls.size() < ours.calls.size()) {
        return "rs274 does less; then ours: " + to_text(ours.calls[theirs.calls.size()]);
    }
    for (std::size_t i = ours.calls.size(); i < theirs.calls.size(); ++i) {
        if (!is_of_the_end(theirs.calls[i])) { return "rs274 does more: " + to_text(theirs.calls[i]); }
    }
    return kept_difference(theirs, ours);
}

}  // namespace

std::string compare(const std::string& text, const Reading& theirs, const Reading& ours) {
    if (!theirs.ended) {
        const bool is_endless = ours.message.find("check that each loop ends") != std::string::npos;
        return is_endless ? "" : "rs274 does not end";
    }
    const Difference difference = difference_of(text, theirs, ours);
    if (difference.is_listed) { return ""; }
    return difference.text.empty() ? difference_at_end(text, theirs, ours) : difference.text;
}

}  // namespace lockstep::oracle
