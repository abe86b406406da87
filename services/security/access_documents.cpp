#include "services/security/access_documents.hpp"

#include <algorithm>
#include <ctime>

#include "services/wire/dds/partitions.hpp"

namespace lockstep {
namespace {

constexpr const char* kHead = "<?xml version=\"1.0\" encoding=\"utf-8\"?>\n<dds>\n";

std::string element(const char* name, const std::string& content) {
    return std::string("<") + name + ">" + content + "</" + name + ">\n";
}

std::string domain_of(const MachineSetup& machine) {
    return element("domains", element("id", std::to_string(machine.network.domain)));
}

/// Returns an empty text if nothing is granted, because a rule without topics is not valid.
std::string rule(const char* what, const Member& member, const std::vector<Role> TopicRights::*granted,
                 const std::vector<std::string>& partitions) {
    std::string topics;
    for (const TopicRights& topic : rights()) {
        if (std::ranges::count(topic.*granted, member.role) > 0) { topics += element("topic", topic.topic); }
    }
    if (topics.empty()) { return ""; }
    std::string places;
    for (const std::string& partition : partitions) { places += element("partition", partition); }
    return element(what, element("topics", topics) + element("partitions", places));
}

constexpr const char* kTimeFormat = "%Y-%m-%dT%H:%M:%S";  // in UTC

std::string xml_time(std::chrono::sys_seconds time) {
    const std::time_t seconds = time.time_since_epoch().count();
    std::tm parts{};
    gmtime_r(&seconds, &parts);
    char text[32];
    (void)std::strftime(text, sizeof text, kTimeFormat, &parts);
    return text;
}

std::optional<std::chrono::sys_seconds> time_in(const std::string& xml, const std::string& name) {
    const std::size_t at = xml.find("<" + name + ">");
    std::tm parts{};
    if (at == xml.npos || strptime(xml.c_str() + at + name.size() + 2, kTimeFormat, &parts) == nullptr) {
        return std::nullopt;
    }
    return std::chrono::sys_seconds(std::chrono::seconds(timegm(&parts)));
}

}  // namespace

std::string governance_xml(const MachineSetup& machine) {
    const std::string topic_rule =
        element("topic_rule", element("topic_expression", "*") + element("enable_discovery_protection", "true") +
                                  element("enable_liveliness_protection", "true") +
                                  element("enable_read_access_control", "true") +
                                  element("enable_write_access_control", "true") +
                                  element("metadata_protection_kind", "ENCRYPT_WITH_ORIGIN_AUTHENTICATION") +
                                  element("data_protection_kind", "NONE"));  // the metadata's protection covers it
    const std::string domain_rule =
        element("domain_rule", domain_of(machine) + element("allow_unauthenticated_participants", "false") +
                                   element("enable_join_access_control", "true") +
                                   element("discovery_protection_kind", "ENCRYPT") +
                                   element("liveliness_protection_kind", "ENCRYPT") +
                                   element("rtps_protection_kind", "NONE") + element("topic_access_rules", topic_rule));
    return kHead + element("domain_access_rules", domain_rule) + "</dds>\n";
}

std::string allow_rule_xml(const MachineSetup& machine, const Member& member) {
    const std::string written =
        rule("publish", member, &TopicRights::writers, {partition_of(machine.name, member.axis)});
    const std::string read = rule("subscribe", member, &TopicRights::readers, read_partitions(machine.name));
    return element("allow_rule", domain_of(machine) + written + read);
}

std::string permissions_xml(const MachineSetup& machine, const Member& member, const std::string& subject,
                            const Period& valid) {
    const std::string grant =
        element("subject_name", subject) +
        element("validity", element("not_before", xml_time(valid.from)) + element("not_after", xml_time(valid.until))) +
        allow_rule_xml(machine, member) + element("default", "DENY");
    return kHead + element("permissions", "<grant name=\"" + member.name + "\">\n" + grant + "</grant>\n") + "</dds>\n";
}

std::optional<Period> period_in(const std::string& permissions_xml) {
    const auto from = time_in(permissions_xml, "not_before");
    const auto until = time_in(permissions_xml, "not_after");
    return from && until ? std::optional(Period{*from, *until}) : std::nullopt;
}

}  // namespace lockstep
