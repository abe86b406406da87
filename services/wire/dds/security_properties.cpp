#include "services/wire/dds/security_properties.hpp"

#include <openssl/crypto.h>

#include <string>

namespace lockstep {
namespace {

void set_plugin(dds_qos_t& qos, const std::string& kind, const std::string& library, const std::string& functions) {
    const std::string prefix = "dds.sec." + kind + ".library.";
    dds_qset_prop(&qos, (prefix + "path").c_str(), (security_plugins() / library).c_str());
    dds_qset_prop(&qos, (prefix + "init").c_str(), ("init_" + functions).c_str());
    dds_qset_prop(&qos, (prefix + "finalize").c_str(), ("finalize_" + functions).c_str());
}

void set_file(dds_qos_t& qos, const char* name, const std::filesystem::path& file) {
    dds_qset_prop(&qos, name, ("file:" + file.string()).c_str());
}

}  // namespace

std::filesystem::path security_plugins() { return LOCKSTEP_DDS_PLUGINS; }

void keep_openssl_alive() { OPENSSL_init_crypto(OPENSSL_INIT_NO_ATEXIT, nullptr); }

void set_security(dds_qos_t& qos, const Credentials& credentials) {
    keep_openssl_alive();
    set_plugin(qos, "auth", "libdds_security_auth.so", "authentication");
    set_plugin(qos, "crypto", "libdds_security_crypto.so", "crypto");
    set_plugin(qos, "access", "libdds_security_ac.so", "access_control");
    set_file(qos, "dds.sec.auth.identity_ca", credentials.identity_ca);
    set_file(qos, "dds.sec.auth.identity_certificate", credentials.certificate);
    set_file(qos, "dds.sec.auth.private_key", credentials.private_key);
    set_file(qos, "dds.sec.access.permissions_ca", credentials.permissions_ca);
    set_file(qos, "dds.sec.access.governance", credentials.governance);
    set_file(qos, "dds.sec.access.permissions", credentials.permissions);
}

}  // namespace lockstep
