#include "tests/benchmarks/wire/benchmark_keys.hpp"

#include <fstream>

#include "services/security/access_documents.hpp"
#include "services/security/certificates.hpp"
#include "services/security/key_directory.hpp"

namespace lockstep {
namespace {

constexpr const char* kAll = "<topics><topic>*</topic></topics><partitions><partition>*</partition></partitions>";

std::string all_allowed(const MachineSetup& machine, const std::string& subject) {
    const Period always = valid_for(std::chrono::days(365));
    std::string text = permissions_xml(machine, client_member(), subject, always);
    const std::string rule = allow_rule_xml(machine, client_member());
    const std::string domain = rule.substr(0, rule.find("</domains>") + 10);
    return text.replace(text.find(rule), rule.size(),
                        domain + "<publish>" + kAll + "</publish><subscribe>" + kAll + "</subscribe></allow_rule>");
}

}  // namespace

bool make_benchmark_keys(const NetworkConfig& network, const std::filesystem::path& directory) {
    MachineSetup machine;
    machine.name = "benchmark";
    machine.network = network;
    constexpr std::chrono::days kValid{1};
    if (!make_keys(machine, directory, valid_for(kValid), false)) { return false; }
    const auto authority = make_authority({machine.name, "permissions"}, valid_for(kValid));
    const std::string subject = "CN=client,O=" + machine.name;
    const Credentials files = benchmark_credentials(directory);
    std::ofstream(files.permissions_ca) << authority->certificate_pem();
    std::ofstream(files.governance) << sign(governance_xml(machine), *authority).value();
    std::ofstream(files.permissions) << sign(all_allowed(machine, subject), *authority).value();
    return true;
}

Credentials benchmark_credentials(const std::filesystem::path& directory) {
    return credentials_in(directory, client_member());
}

}  // namespace lockstep
