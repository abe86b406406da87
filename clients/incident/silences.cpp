#include "clients/incident/silences.hpp"

#include <fmt/format.h>

#include <algorithm>

#include "clients/incident/sentences.hpp"

namespace lockstep::incident {
namespace {

bool is_silence(const FlightEvent& event) {
    return event.kind == FlightKind::PeerSilent || (event.kind == FlightKind::PeerReceived && event.lasts > Ticks{});
}

/// The processes that are observer or subject of every silence.
std::vector<FlightPeer> common(const std::vector<Silence>& silences) {
    std::vector<FlightPeer> in_all;
    for (const FlightPeer who : {silences.front().observer, silences.front().about}) {
        const auto has_part = [&](const Silence& s) { return s.observer == who || s.about == who; };
        if (std::ranges::all_of(silences, has_part)) { in_all.push_back(who); }
    }
    return in_all;
}

std::string cut_text(const Incident& incident, FlightPeer who, const std::vector<Silence>& silences) {
    const auto receives_none = std::ranges::count(silences, who, &Silence::observer);
    const auto unreceived = std::ranges::count(silences, who, &Silence::about);
    const std::string name = peer_name(incident, who);
    if (receives_none == 0) { return name + " was cut off: no process received its messages, although it ran"; }
    if (unreceived == 0) { return name + " was cut off: it received no messages, although all processes ran"; }
    return name + " was cut off: it received no messages and no process received its messages, although all ran";
}

std::string link_text(const Incident& incident, const std::vector<Silence>& silences) {
    const Silence& first = silences.front();
    const bool both_ways = silences.size() > 1;
    return fmt::format("the link {}{}{}{} carried no messages, although both ran", both_ways ? "between " : "from ",
                       peer_name(incident, first.about), (both_ways ? " and " : " to "),
                       peer_name(incident, first.observer));
}

}  // namespace

std::vector<Silence> silences(const Incident& incident, Tick from, Tick to) {
    std::vector<Silence> found;
    for (const Entry& entry : incident.timeline) {
        const FlightEvent& event = entry.event;
        if (!is_silence(event) || event.tick < from || event.tick - event.lasts > to) { continue; }
        const FlightPeer observer = incident.processes[entry.process].who;
        const auto same = std::ranges::find_if(
            found, [&](const Silence& s) { return s.observer == observer && s.about == event.about; });
        if (same == found.end()) {
            found.push_back({observer, event.about, event.tick - event.lasts, event.lasts});
        } else {
            same->lasts = std::max(same->lasts, event.tick - same->from);
        }
    }
    return found;
}

std::optional<CutOff> cut_off(const Incident& incident, const std::vector<Silence>& silences) {
    if (silences.empty()) { return std::nullopt; }
    CutOff cut{.who = {}, .from = silences.front().from, .lasts = {}, .text = {}};
    for (const Silence& s : silences) {
        cut.from = std::min(cut.from, s.from);
        cut.lasts = std::max(cut.lasts, s.lasts);
    }
    const auto in_all = common(silences);
    if (in_all.size() == 1) {
        cut.who = in_all.front();
        cut.text = cut_text(incident, *cut.who, silences);
    } else if (in_all.size() == 2) {
        cut.text = link_text(incident, silences);
    } else {
        cut.text = "several links of the network carried no messages, although the processes ran";
    }
    return cut;
}

}  // namespace lockstep::incident
