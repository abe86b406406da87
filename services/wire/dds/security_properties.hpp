// The properties by which a DDS participant is given its credentials (OMG DDS Security 1.1, 9.3 to 9.5).
#pragma once

#include <dds/dds.h>

#include <filesystem>

#include "services/wire/dds/participant.hpp"

namespace lockstep {

/// Where Cyclone DDS's security plugins are.
std::filesystem::path security_plugins();

/// DDS's threads go on until the process is gone, and must find OpenSSL alive: its own cleaning up at exit is switched
/// off. To be called before anything else of OpenSSL.
void keep_openssl_alive();

void set_security(dds_qos_t& qos, const Credentials& credentials);

}  // namespace lockstep
