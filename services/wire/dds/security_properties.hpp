// The properties by which a DDS participant gets its credentials (OMG DDS Security 1.1, 9.3 to 9.5).
#pragma once

#include <dds/dds.h>

#include <filesystem>

#include "services/wire/dds/participant.hpp"

namespace lockstep {

/// Where Cyclone DDS's security plugins are.
std::filesystem::path security_plugins();

/// DDS's threads run until the process has ended, and still use OpenSSL: disables OpenSSL's cleanup at exit. Call it
/// before any other OpenSSL function.
void keep_openssl_alive();

void set_security(dds_qos_t& qos, const Credentials& credentials);

}  // namespace lockstep
