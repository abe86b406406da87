// A process's place in DDS: one domain, one interface, one machine.
//
// The profile is built from the configuration, not read from the environment, so that every process of a machine has
// the same. Where CYCLONEDDS_URI is set it is read after ours: it may add to it (security, tracing) or override it.
#pragma once

#include <expected>
#include <optional>
#include <string>

#include "core/machine.hpp"
#include "services/wire/entity.hpp"

namespace lockstep {

class Participant {
public:
    /// The machine's name becomes the DDS partition: machines in one domain do not hear each other.
    /// Error: the domain, the interface, what DDS said, and the remedy. All participants of a process in one domain
    /// use one interface.
    static std::expected<Participant, std::string> open(const NetworkConfig& network, const std::string& machine);

    dds_entity_t handle() const { return participant_.handle(); }
    dds_entity_t publisher() const { return publisher_.handle(); }
    dds_entity_t subscriber() const { return subscriber_.handle(); }

    /// The first failure of a reader or writer made on this participant: so that many can be made in a row and
    /// looked at once.
    const std::optional<std::string>& failure() const { return failure_; }
    void note_failure(std::string text);

private:
    Participant() = default;

    Entity participant_;
    Entity publisher_;
    Entity subscriber_;
    std::optional<std::string> failure_;
};

/// The Cyclone DDS configuration of a machine's processes, as XML. Error: the interface's name is none.
std::expected<std::string, std::string> dds_profile(const NetworkConfig& network);

}  // namespace lockstep
