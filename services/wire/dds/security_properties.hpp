// Sets the properties that give a DDS participant its credentials (OMG DDS Security 1.1, 9.3 to 9.5).
#pragma once

#include <dds/dds.h>

#include <filesystem>

#include "services/wire/dds/participant.hpp"

namespace lockstep {

/// The directory of Cyclone DDS's security plugins.
std::filesystem::path security_plugins();

/// Disables OpenSSL's cleanup at exit, because DDS's threads use OpenSSL until the process has ended. Call it before
/// any other OpenSSL function.
void keep_openssl_alive();

void set_security(dds_qos_t& qos, const Credentials& credentials);

}  // namespace lockstep
