// A process's participant in DDS, with one domain, one interface, one machine, and the process's identity.
#pragma once

#include <cstdint>
#include <expected>
#include <filesystem>
#include <memory>
#include <optional>
#include <string>

#include "services/network/interface_identity.hpp"
#include "services/setup/machine_setup.hpp"
#include "services/wire/dds/domain.hpp"
#include "services/wire/dds/entity.hpp"
#include "services/wire/dds/sent_keys.hpp"

namespace lockstep {

/// The files that identify a process to DDS Security and grant its rights: PEM certificates and keys, signed documents.
struct Credentials {
    std::filesystem::path identity_ca;
    std::filesystem::path certificate;
    std::filesystem::path private_key;
    std::filesystem::path permissions_ca;
    std::filesystem::path governance;
    std::filesystem::path permissions;
};

/// The identity with which a process joins a machine.
struct Membership {
    std::optional<std::uint32_t> axis;       // the axis for which the process writes, if any
    std::optional<Credentials> credentials;  // nullopt: without security
};

class Participant {
public:
    /// The machine's name determines the DDS partition (partitions.hpp), so machines in one domain do not receive each
    /// other. Error: the domain, the interface, DDS's error, and the remedy. All participants of a process in one
    /// domain use one interface.
    static std::expected<Participant, std::string> open(const NetworkConfig& network, const std::string& machine,
                                                        const Membership& membership = {});

    const std::string& machine() const { return machine_; }
    const NetworkConfig& network() const { return network_; }
    const std::optional<std::uint32_t>& axis() const { return axis_; }  // the axis for which its process writes

    dds_entity_t handle() const { return participant_.handle(); }
    dds_entity_t publisher() const { return publisher_.handle(); }
    dds_entity_t subscriber() const { return subscriber_.handle(); }

    /// Whether the interface was replaced or got another address since this participant was opened.
    bool has_interface_changed() const;

    /// The first failed creation of a reader or writer on this participant. A caller can create many and check once.
    const std::optional<std::string>& failure() const { return failure_; }
    void note_failure(std::string text);

private:
    Participant() = default;

    std::shared_ptr<const Domain> domain_;  // must outlive the members below
    std::string machine_;
    NetworkConfig network_;
    std::optional<std::uint32_t> axis_;
    std::optional<InterfaceIdentity> interface_;
    Entity participant_;
    Entity publisher_;
    Entity subscriber_;
    std::unique_ptr<SentKeys> sent_keys_;  // with security
    std::optional<std::string> failure_;
};

}  // namespace lockstep
