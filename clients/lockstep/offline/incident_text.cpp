#include "clients/lockstep/offline/incident_text.hpp"

#include <fmt/format.h>

#include <algorithm>

#include "clients/incident/notes.hpp"
#include "clients/text/format.hpp"

namespace lockstep::incident {
namespace {

constexpr std::size_t kTimeWidth = 12;
constexpr int kMostListed = 10;

std::size_t name_width(const Incident& incident) {
    std::size_t width = 0;
    for (const Process& process : incident.processes) { width = std::max(width, process.name.size()); }
    return std::min<std::size_t>(width, 30);
}

/// `what` after `head`, in lines of at most `width` characters that begin below the first.
std::string hanging(const std::string& head, const std::string& what, std::size_t width) {
    const std::size_t room = std::max<std::size_t>(20, width - std::min(width, head.size()));
    std::string text = wrapped(what, room, "");
    const std::string indent(head.size(), ' ');
    for (std::size_t at = text.find('\n'); at != text.npos; at = text.find('\n', at + 1 + indent.size())) {
        text.insert(at + 1, indent);
    }
    return head + text + "\n";
}

std::string row(const std::string& time, const std::string& name, const std::string& what, std::size_t names,
                std::size_t width) {
    return hanging(fmt::format("{:>{}}  {:<{}}  ", time, kTimeWidth, name, names), what, width);
}

}  // namespace

std::string to_text(const Incident& incident, const Evaluation& evaluation, const TextOptions& options) {
    std::string text =
        fmt::format("incident of machine {}, recorded {}\n\n", incident.machine.name, wall_time(incident.wall_us));
    for (std::size_t i = 0; i < evaluation.story.size(); ++i) {
        text += wrapped((i == 0 ? "" : "-> ") + evaluation.story[i], options.width, "   ") + "\n";
    }
    const std::size_t names = name_width(incident);
    text += "\n" + row("s", "process", "event; 0 s: noticed first", names, options.width);
    std::size_t left_out = 0;
    std::string before;  // an axis may note the same twice in one loop: the coordinator and a peer stopped it
    for (const Entry& entry : incident.timeline) {
        if (weight_of(incident, entry) < options.least) {
            ++left_out;
            continue;
        }
        const double at = incident.seconds(entry.tick - evaluation.noticed);
        const std::string next = row(fmt::format("{:+.3f}", at), incident.processes[entry.process].name,
                                     sentence(incident, entry), names, options.width);
        text += next == before ? "" : next;
        before = next;
    }
    if (left_out > 0) { text += fmt::format("\n{} more routine events: --all\n", left_out); }
    for (const std::string& note : notes_of(incident)) { text += wrapped(note, options.width, "   ") + "\n"; }
    return text;
}

std::string list_text(const proto::IncidentReport& report, std::size_t width) {
    const int count = report.incidents_size();
    if (count < 2) { return ""; }
    std::string text = fmt::format("{} incidents in these files, the newest first; --back N reports another:\n", count);
    const int back = static_cast<int>(report.back());
    const int first = std::clamp(back - kMostListed / 2, 0, std::max(0, count - kMostListed));
    const int end = std::min(count, first + kMostListed);
    for (const auto& summary : report.incidents()) {
        if (summary.back() < first || summary.back() >= end) { continue; }
        const std::string head = fmt::format("  --back {:<3} {}  ", summary.back(), summary.written());
        const std::string body = summary.text() + (summary.back() == back ? " (this one)" : "");
        text += hanging(head, body, width);
    }
    if (end - first < count) { text += fmt::format("  and {} more\n", count - (end - first)); }
    return text;
}

}  // namespace lockstep::incident
